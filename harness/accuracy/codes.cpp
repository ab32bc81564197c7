// SPDX-License-Identifier: MIT
//
// The axis codes: what more bits a code and other cells buy, in the tree and in a query of it, against the pairs that a
// sweep finds.
#include "collide/sweep.h"
#include "harness/accuracy/axes.h"
#include "harness/accuracy/code_counts.h"
#include "harness/accuracy/scene_input.h"
#include "harness/failure.h"
#include "harness/metrics.h"
#include "harness/report.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

using enum Table::Align;

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
        if (order.code == nullptr || order.medians != Medians::nowhere)
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

void prepare(Session& session, const Method& method, const Input& input, Measured& one,
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

std::string count_text(const Cell& cell, const char* counter)
{
    const auto at = cell.counters.find(counter);
    return at == cell.counters.end() ? "" : grouped(static_cast<std::int64_t>(at->second));
}

double stage_median(const Cell& cell, std::string_view stage)
{
    return spread_of(stage_times_ns(cell, stage)).median;
}

/// Of all stages but the query.
double build_median(const Cell& cell)
{
    std::vector<double> all = whole_times_ns(cell);
    const std::vector<double> query = stage_times_ns(cell, "broad");
    for (std::size_t k = 0; k < all.size(); ++k)
        all[k] -= query[k];
    return spread_of(all).median;
}

}  // namespace

void measure_codes(const AxisRun& run)
{
    const auto measure = [&](const SceneFacts& scene, const Input& input) {
        const PairList right = touching_pairs(input.points, input.faces, true);
        std::vector<Measured> cells;
        std::vector<std::unique_ptr<Pipeline>> pipelines;
        for (const Method& method : methods(input.objects.size())) {
            if (!run.task.wants(scene.name, method.name))
                continue;
            Measured& one = cells.emplace_back();
            one.cell = accuracy_cell("codes", method.name, scene);
            one.cell.builder = method.builder;
            one.cell.collider = {.name = "leaf"};
            const std::string failure = reason_of_failure(
                [&] { prepare(run.session, method, input, one, pipelines.emplace_back()); });
            if (!failure.empty())
                one.fail(run.session, failure);
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

std::string report_codes(const Document& document)
{
    Table table({{"scene", left},
                 {"codes", left},
                 {"duplicates"},
                 {"longest run"},
                 {"surface area cost"},
                 {"box tests"},
                 {"codes and sort"},
                 {"build"},
                 {"query"},
                 {"missed"},
                 {"false"},
                 {"verdict", left}});
    const std::vector<const Cell*> cells = cells_of(document, "codes");
    for (const Cell* cell : cells) {
        if (!has_times(*cell)) {
            table.row({cell->scene.name, cell->accuracy.method, "", "", "", "", "", "", "", "", "",
                       why_text(*cell)});
            continue;
        }
        const auto cost = cell->counters.find("sah_cost");
        table.row({cell->scene.name, cell->accuracy.method, count_text(*cell, "duplicates_count"),
                   count_text(*cell, "longest_run_count"),
                   cost == cell->counters.end() ? "" : fixed(cost->second, 2),
                   count_text(*cell, "box_tests_count"),
                   duration_text(stage_median(*cell, "codes") + stage_median(*cell, "sort")),
                   duration_text(build_median(*cell)), duration_text(stage_median(*cell, "broad")),
                   count_text(*cell, "missed_count"), count_text(*cell, "false_count"),
                   verdict_text(*cell)});
    }
    return cells.empty() ? "" : table.text();
}

}  // namespace bvhbench
