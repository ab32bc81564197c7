// SPDX-License-Identifier: MIT
//
// The axis sums: the surface area cost of a tree by several ways of adding areas up, against long double.
#include <cmath>
#include <cstdio>

#include "geometry/error.h"
#include "harness/accuracy/area_sums.h"
#include "harness/accuracy/axes.h"
#include "harness/accuracy/scene_input.h"

namespace bvhbench {
namespace {

/// What our own sum may be off by: a few roundings of doubles, however many nodes.
constexpr double most_of_ours = 1e-14;

Subject summed(const AxisRun& run, const SceneFacts& scene, const SumMethod& method,
               const HostTree& tree, long double right)
{
    Cell cell = accuracy_cell("sums", std::string(method.name), scene);
    const double cost = method.cost(tree);
    const double error = static_cast<double>(std::fabs((cost - right) / right));
    cell.counters["nodes_count"] = static_cast<double>(tree.nodes.size());
    cell.counters["sah_cost"] = cost;
    cell.counters["relative_error"] = error;
    cell.check.against = "long double";
    cell.check.verdict = !method.is_ours         ? Check::Verdict::counted
                         : error <= most_of_ours ? Check::Verdict::agrees
                                                 : Check::Verdict::differs;
    if (cell.check.verdict == Check::Verdict::differs)
        cell.check.detail = "off by more than a few roundings";
    Queue& queue = run.session.queue();
    const auto once = [&queue, &method, &tree, cost] {
        queue.on_host("sum", [&] {
            if (method.cost(tree) != cost)
                throw Unavailable("another sum the second time");
        });
        return queue.finish();
    };
    return {.cell = std::move(cell), .once = once};
}

}  // namespace

void measure_sums(const AxisRun& run)
{
    for_each_scene(
        run, "sums", {"torus:100000", "hairball:100000", "torus:1000000"},
        [&](const SceneFacts& scene, const Input& input) {
            const HostTree tree = built_tree(run.session, {.name = "oibvh-multi"}, input);
            const long double right = cost_in_long_double(tree);
            if (!(right > 0))
                throw Unavailable(scene.name + " has no surface area cost: its box has no area");
            std::vector<Subject> cells;
            for (const SumMethod& method : sum_methods())
                if (run.task.wants(scene.name, method.name))
                    cells.push_back(summed(run, scene, method, tree, right));
            take_samples_of(run, cells);
            for (Subject& one : cells)
                run.add(std::move(one.cell));
        });
}

}  // namespace bvhbench
