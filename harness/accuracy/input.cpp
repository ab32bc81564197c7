// SPDX-License-Identifier: MIT
//
// The axis input: what rounding vertices from doubles to floats adds to the pairs of boxes, against the boxes of doubles.
// It takes none away: rounding to nearest keeps the order of coordinates, so boxes that overlapped still do.
#include <cmath>

#include "harness/accuracy/axes.h"
#include "harness/accuracy/differences.h"
#include "harness/accuracy/scene_input.h"
#include "harness/accuracy/turned_scene.h"
#include "harness/failure.h"
#include "harness/pipeline.h"
#include "harness/report.h"
#include "harness/sampler.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

using enum Table::Align;

constexpr int warm_up = 1;
/// How far off, in sizes of the scene. A float has 24 bits: at 1e7 sizes little is left.
constexpr double distances[] = {0, 1e2, 1e3, 1e4, 1e5, 1e6};
constexpr std::string_view methods[] = {"f32", "f32-recentred"};

std::string name_at(const std::string& scene, double sizes)
{
    return scene + " at 1e" + std::to_string(sizes > 0 ? std::lround(std::log10(sizes)) : 0);
}

void measure_rounded(const AxisRun& run, std::span<const WidePoint> wide, const Input& scene,
                     const PairList& right, Cell& cell)
{
    Session& session = run.session;
    const std::vector<Point> points = rounded(wide, cell.accuracy.method == methods[1]);
    const Input input = upload(session.device(), session.queue(), points, scene.faces);
    Pipeline pipeline(session, cell.builder, cell.collider, input);
    pipeline.begin_frame({});
    pipeline.settle(input);
    cell.counters = pipeline.counters();
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
    cell.counters["right_pairs_count"] = static_cast<double>(right.size());
    cell.counters["missed_count"] = static_cast<double>(wrong.missed);
    cell.counters["false_count"] = static_cast<double>(wrong.false_ones);
    cell.check = {.verdict = wrong.missed == 0 ? Check::Verdict::counted : Check::Verdict::differs,
                  .against = "boxes of doubles",
                  .detail = wrong.missed == 0 ? "" : "rounding must not take pairs away",
                  .pairs_hash = found.hash()};
}

}  // namespace

void measure_input(const AxisRun& run)
{
    for_each_scene(run, "input", {"torus:20000"}, [&](const SceneFacts& scene, const Input& input) {
        for (const double sizes : distances) {
            const std::vector<WidePoint> wide = turned_and_moved(input.points, sizes);
            const PairList right = overlapping_pairs_in_doubles(wide, input.faces);
            for (const std::string_view method : methods) {
                SceneFacts facts = scene;
                facts.name = name_at(scene.name, sizes);
                if (!run.task.wants(facts.name, method))
                    continue;
                Cell cell = accuracy_cell("input", std::string(method), facts);
                cell.builder = {.name = "oibvh-multi"};
                cell.collider = {.name = "leaf"};
                cell.warm_up = warm_up;
                const std::string failure = reason_of_failure(
                    [&] { measure_rounded(run, wide, input, right, cell); });
                if (!failure.empty()) {
                    run.session.renew_queue();
                    cell.status = Cell::Status::failed;
                    cell.reason = failure;
                }
                run.add(std::move(cell));
            }
        }
    });
}

std::string report_input(const Document& document)
{
    Table table({{"scene", left},
                 {"vertices", left},
                 {"pairs of doubles"},
                 {"missed"},
                 {"false"},
                 {"times as many"},
                 {"frame"},
                 {"verdict", left}});
    const std::vector<const Cell*> cells = cells_of(document, "input");
    for (const Cell* cell : cells) {
        if (!has_times(*cell)) {
            table.row({cell->scene.name, cell->accuracy.method, "", "", "", "", "",
                       verdict_text(*cell) + ": " + cell->reason + cell->check.detail});
            continue;
        }
        const auto count = [&](const char* counter) {
            return grouped(static_cast<std::int64_t>(cell->counters.at(counter)));
        };
        const double right = cell->counters.at("right_pairs_count");
        table.row({cell->scene.name, cell->accuracy.method, count("right_pairs_count"),
                   count("missed_count"), count("false_count"),
                   right > 0 ? fixed(cell->counters.at("pairs_count") / right, 3) : "",
                   duration_text(spread_of(whole_times_ns(*cell)).median), verdict_text(*cell)});
    }
    return cells.empty() ? "" : table.text();
}

}  // namespace bvhbench
