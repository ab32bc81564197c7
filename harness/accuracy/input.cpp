// SPDX-License-Identifier: MIT
//
// The axis input: what rounding vertices from doubles to floats adds to the pairs of boxes, against the boxes of doubles.
// It takes none away: rounding to nearest keeps the order of coordinates, so boxes that overlapped still do.
#include <cmath>
#include <list>

#include "harness/accuracy/axes.h"
#include "harness/accuracy/scene_input.h"
#include "harness/accuracy/turned_scene.h"
#include "harness/base/failure.h"

namespace bvhbench {
namespace {

/// How far off, in sizes of the scene. A float has 24 bits: at 1e7 sizes little is left.
constexpr double distances[] = {0, 1e2, 1e3, 1e4, 1e5, 1e6};
constexpr std::string_view methods[] = {"f32", "f32-recentred"};

std::string name_at(const std::string& scene, double sizes)
{
    return scene + " at " +
           (sizes > 0 ? "1e" + std::to_string(std::lround(std::log10(sizes))) : "0");
}

/// A scene of floats on the device, and the pipeline over it.
struct Rounded {
    std::vector<Point> points;
    Input input;
    std::unique_ptr<Pipeline> pipeline;
};

/// Pairs that rounding adds are what is counted; it must take none away.
void judge(const Rounded& rounded, const PairList& right, Cell& cell)
{
    judge_pairs(*rounded.pipeline, right, "boxes of doubles", cell);
    cell.counters["right_pairs_count"] = static_cast<double>(right.size());
    if (cell.counters["missed_count"] > 0)
        return;
    cell.check.verdict = Check::Verdict::counted;
    cell.check.detail.clear();
}

}  // namespace

void measure_input(const AxisRun& run)
{
    for_each_scene(run, "input", {"torus:20000"}, [&](const SceneFacts& scene, const Input& input) {
        for (const double sizes : distances) {
            const std::vector<WidePoint> wide = turned_and_moved(input.points, sizes);
            const PairList right = overlapping_pairs_in_doubles(wide, input.faces);
            std::vector<Subject> cells;
            std::list<Rounded> all;  // which stay where they are
            for (const std::string_view method : methods) {
                SceneFacts facts = scene;
                facts.name = name_at(scene.name, sizes);
                if (!run.task.wants(facts.name, method))
                    continue;
                Subject& one = cells.emplace_back();
                one.cell = accuracy_cell("input", std::string(method), facts);
                one.cell.builder = {.name = "oibvh-multi"};
                one.cell.collider = {.name = "leaf"};
                Rounded& floats = all.emplace_back();
                const std::string failure = reason_of_failure([&] {
                    Session& session = run.session;
                    floats.points =
                        rounded(wide, method == methods[1] ? Doubles::recentred : Doubles::as_is);
                    floats.input =
                        upload(session.device(), session.queue(), floats.points, input.faces);
                    floats.pipeline = settled_pipeline(session, one.cell, floats.input);
                    one.once = [&floats] { return floats.pipeline->once(floats.input); };
                });
                if (!failure.empty())
                    fail(run.session, one, failure);
            }
            take_samples_of(run, cells);
            auto floats = all.begin();
            for (Subject& one : cells) {
                if (one.once)
                    judge(*floats, right, one.cell);
                ++floats;
                run.add(std::move(one.cell));
            }
        }
    });
}

}  // namespace bvhbench
