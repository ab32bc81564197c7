// SPDX-License-Identifier: MIT
//
// The axis codes: what more bits a code and other cells buy, in the tree and in a query of it, against the pairs that a
// sweep finds.
#include "collide/sweep.h"
#include "harness/accuracy/axes.h"
#include "harness/accuracy/code_counts.h"
#include "harness/accuracy/differences.h"
#include "harness/accuracy/scene_input.h"
#include "harness/failure.h"
#include "harness/metrics.h"
#include "harness/pipeline.h"
#include "harness/report.h"
#include "harness/sampler.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

using enum Table::Align;

constexpr int warm_up = 1;

void measure_order(const AxisRun& run, const OrderEntry& order, const Input& input,
                   const PairList& right, Cell& cell)
{
    Session& session = run.session;
    Pipeline pipeline(session, cell.builder, cell.collider, input);
    pipeline.begin_frame({});
    pipeline.settle(input);
    cell.counters = pipeline.counters();
    const Quality quality = quality_of(built_tree(session, cell.builder, input));
    cell.counters.insert(quality.counters.begin(), quality.counters.end());
    cell.left_out = quality.left_out;
    const CodeCounts codes = code_counts(order, input.points, input.faces);
    cell.counters["duplicates_count"] = static_cast<double>(codes.duplicates);
    cell.counters["longest_run_count"] = static_cast<double>(codes.longest_run);

    const Timed timed = {cell.accuracy.method, [&] { return pipeline.once(input); }};
    Taken taken = take_samples({&timed, 1}, run.task.samples, warm_up, run.order).front();
    if (!taken.failure.empty()) {
        cell.status = Cell::Status::failed;
        cell.reason = taken.failure;
        return;
    }
    cell.samples = std::move(taken.samples);
    const PairList found = pipeline.pairs();
    const Differences wrong = differences(found, right);
    cell.counters["missed_count"] = static_cast<double>(wrong.missed);
    cell.counters["false_count"] = static_cast<double>(wrong.false_ones);
    cell.check = {.verdict = wrong == Differences{} ? Check::Verdict::agrees : Check::Verdict::differs,
                  .against = "brute",
                  .detail = {},
                  .pairs_hash = found.hash()};
    if (cell.check.verdict == Check::Verdict::differs)
        cell.check.detail = std::to_string(wrong.missed) + " pairs missed, " +
                            std::to_string(wrong.false_ones) + " false";
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
        run, "codes", {"torus:100000", "hairball:100000", "grid:100000", "outlier:sphere:100000:0:1000"},
        [&](const SceneFacts& scene, const Input& input) {
            const PairList right = touching_pairs(input.points, input.faces, true);
            for (const OrderEntry& order : order_catalog()) {
                if (order.code == nullptr || order.medians != Medians::nowhere ||
                    !run.task.wants(scene.name, order.name))
                    continue;
                Cell cell = accuracy_cell("codes", std::string(order.name), scene);
                cell.builder = {.name = "oibvh-multi", .order = std::string(order.name)};
                cell.collider = {.name = "leaf"};
                cell.warm_up = warm_up;
                const std::string failure = reason_of_failure(
                    [&] { measure_order(run, order, input, right, cell); });
                if (!failure.empty()) {
                    run.session.renew_queue();
                    cell.status = Cell::Status::failed;
                    cell.reason = failure;
                }
                run.add(std::move(cell));
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
                       verdict_text(*cell) + ": " + cell->reason + cell->check.detail});
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
