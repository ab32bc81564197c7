// SPDX-License-Identifier: MIT
//
// The axis codes: what more bits a code and other cells buy, in the tree and in a query of it, against the pairs that a
// sweep finds.
#include "collide/oracles/sweep.h"
#include "harness/accuracy/axes.h"
#include "harness/accuracy/code_counts.h"
#include "harness/accuracy/scene_input.h"
#include "harness/base/failure.h"
#include "harness/judge/metrics.h"

namespace bvhbench {
namespace {

/// A way to put leaves in order: on the axis codes, and what they are held against.
struct Method {
    std::string name;
    BuilderChoice builder;
    const OrderEntry* codes = nullptr;  ///< null where nothing is said about codes
};

/// Orders along curves over `objects`, on grids over each object and, where there are several, over the scene; and, to
/// say what else there is, medians, which need one object, and a radix tree.
std::vector<Method> methods(std::size_t objects)
{
    std::vector<Method> all;
    for (const OrderEntry& order : order_catalog()) {
        if (order.medians != Medians::nowhere)
            continue;
        const std::string name(order.name);
        all.push_back({name, {.name = "oibvh-multi", .order = name}, &order});
        if (objects > 1)
            all.push_back({name + "-scene",
                           {.name = "oibvh-multi", .order = name, .grid = GridOver::scene},
                           &order});
    }
    if (objects == 1)
        all.push_back({"kd", {.name = "oibvh-multi", .order = "kd"}});
    all.push_back({"radix", {.name = "apetrei-fused"}});
    return all;
}

void prepare(Session& session, const Method& method, const Input& input, Subject& one,
             std::unique_ptr<Pipeline>& pipeline)
{
    Cell& cell = one.cell;
    pipeline = settled_pipeline(session, cell, input);
    if (const auto cost = forest_cost(session, cell.builder, input))
        cell.counters["sah_cost"] = *cost;
    else
        cell.left_out["sah_cost"] = "no root has an area";
    if (method.codes != nullptr) {
        const CodeCounts codes = code_counts(*method.codes, input.points, input.faces,
                                             input.objects, method.builder.grid);
        cell.counters["duplicates_count"] = static_cast<double>(codes.duplicates);
        cell.counters["longest_run_count"] = static_cast<double>(codes.longest_run);
    }
    one.once = [&input, frame = pipeline.get()] { return frame->once(input); };
}

}  // namespace

void measure_codes(const AxisRun& run)
{
    const auto measure = [&](const SceneFacts& scene, const Input& input) {
        const PairList right = touching_pairs(input.points, input.faces, true);
        std::vector<Subject> cells;
        std::vector<std::unique_ptr<Pipeline>> pipelines;
        for (const Method& method : methods(input.objects.size())) {
            if (!run.task.wants(scene.name, method.name))
                continue;
            Subject& one = cells.emplace_back();
            one.cell = accuracy_cell("codes", method.name, scene);
            one.cell.builder = method.builder;
            one.cell.collider = {.name = "leaf"};
            const std::string failure = reason_of_failure(
                [&] { prepare(run.session, method, input, one, pipelines.emplace_back()); });
            if (!failure.empty())
                fail(run.session, one, failure);
        }
        take_samples_of(run, cells);
        for (std::size_t k = 0; k < cells.size(); ++k) {
            if (cells[k].once)
                judge_pairs(*pipelines[k], right, "brute", cells[k].cell);
            run.add(std::move(cells[k].cell));
        }
    };
    for_each_scene(run, "codes",
                   {"torus:100000", "hairball:100000", "grid:100000",
                    "outlier:sphere:100000:0:1000", "n-body:100000"},
                   measure, true);
}

}  // namespace bvhbench
