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

void prepare(Session& session, const OrderEntry& order, const Input& input, Measured& one,
             std::unique_ptr<Pipeline>& pipeline)
{
    Cell& cell = one.cell;
    pipeline = settled_pipeline(session, cell, input);
    Quality quality = quality_of(built_tree(session, cell.builder, input));
    cell.counters.merge(quality.counters);
    cell.left_out = quality.left_out;
    const CodeCounts codes = code_counts(order, input.points, input.faces);
    cell.counters["duplicates_count"] = static_cast<double>(codes.duplicates);
    cell.counters["longest_run_count"] = static_cast<double>(codes.longest_run);
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

}  // namespace

void measure_codes(const AxisRun& run)
{
    for_each_scene(
        run, "codes",
        {"torus:100000", "hairball:100000", "grid:100000", "outlier:sphere:100000:0:1000"},
        [&](const SceneFacts& scene, const Input& input) {
            const PairList right = touching_pairs(input.points, input.faces, true);
            std::vector<Measured> cells;
            std::vector<std::unique_ptr<Pipeline>> pipelines;
            for (const OrderEntry& order : order_catalog()) {
                if (order.code == nullptr || order.medians != Medians::nowhere ||
                    !run.task.wants(scene.name, order.name))
                    continue;
                Measured& one = cells.emplace_back();
                one.cell = accuracy_cell("codes", std::string(order.name), scene);
                one.cell.builder = {.name = "oibvh-multi", .order = std::string(order.name)};
                one.cell.collider = {.name = "leaf"};
                const std::string failure = reason_of_failure(
                    [&] { prepare(run.session, order, input, one, pipelines.emplace_back()); });
                if (!failure.empty())
                    one.fail(run.session, failure);
            }
            take_samples_of(run, cells);
            for (std::size_t k = 0; k < cells.size(); ++k) {
                if (cells[k].once)
                    judge_pairs(*pipelines[k], right, "brute", cells[k].cell);
                run.add(std::move(cells[k].cell));
            }
        });
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
                 {"query"},
                 {"missed"},
                 {"false"},
                 {"verdict", left}});
    const std::vector<const Cell*> cells = cells_of(document, "codes");
    for (const Cell* cell : cells) {
        if (!has_times(*cell)) {
            table.row({cell->scene.name, cell->accuracy.method, "", "", "", "", "", "", "", "",
                       why_text(*cell)});
            continue;
        }
        const auto cost = cell->counters.find("sah_cost");
        table.row({cell->scene.name, cell->accuracy.method, count_text(*cell, "duplicates_count"),
                   count_text(*cell, "longest_run_count"),
                   cost == cell->counters.end() ? "" : fixed(cost->second, 2),
                   count_text(*cell, "box_tests_count"),
                   duration_text(stage_median(*cell, "codes") + stage_median(*cell, "sort")),
                   duration_text(stage_median(*cell, "broad")), count_text(*cell, "missed_count"),
                   count_text(*cell, "false_count"), verdict_text(*cell)});
    }
    return cells.empty() ? "" : table.text();
}

}  // namespace bvhbench
