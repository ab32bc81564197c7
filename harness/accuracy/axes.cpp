// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iterator>
#include <sstream>

#include "collide/narrow/narrow_methods.h"
#include "geometry/names.h"
#include "harness/accuracy/axis.h"
#include "harness/base/failure.h"
#include "harness/judge/pair_counts.h"
#include "harness/measure/frames.h"
#include "scenes/face_order.h"

namespace bvhbench {
namespace {

// To add an axis, add a file and a line here.
constexpr Axis catalog[] = {
    {"narrow",
     "which narrow phase is wrong how often, on which pairs of triangles, and what it takes",
     measure_narrow},
    {"sums", "how far off is the surface area cost, by how areas are summed", nullptr, measure_sums,
     "torus:100000 hairball:100000 torus:1000000"},
    {"codes", "what do more bits a code and cubic cells buy: duplicates, tree, box tests", nullptr,
     measure_codes,
     "torus:100000 hairball:100000 grid:100000 outlier:sphere:100000:0:1000 n-body:100000", true},
    {"input", "what does rounding vertices from doubles to floats add to the pairs of boxes",
     nullptr, measure_input, "torus:20000"},
    {"place",
     "what does exact arithmetic take, by the distance from the origin and the triangles' size",
     nullptr, measure_place, "two-spheres:2000 two-spheres:20000 two-spheres:200000"},
    {"boxes", "what do fewer bytes a box cost in false pairs and save in time", nullptr,
     measure_boxes, "torus:100000 hairball:100000"},
    {"swept",
     "who finds the pairs that may meet between two frames, how soon, and how many for each that "
     "does",
     measure_swept},
    {"frames",
     "what does a frame cost and how many contacts does it miss or invent, by how it is rounded",
     nullptr, measure_frames, "unc_cloth_ball unc_nbody ipc_armadillo_rollers n-body:146480 funnel",
     false, 3},
    {"impacts",
     "what does a smaller tolerance of the narrow phase between two frames take, and which false "
     "pairs does it save",
     measure_impacts},
    {"queries",
     "which continuous collision detection misses which single queries, what it takes, and how far "
     "its times are before the right ones",
     measure_queries},
    {"distance",
     "which narrow phase finds which triangles within a distance, what it takes, and how far off "
     "its distances are",
     measure_distance},
};

/// Returns up to `most` of the numbers below `count`, the first and the last among them.
std::vector<std::size_t> spread(std::size_t count, std::size_t most)
{
    std::vector<std::size_t> numbers{0};
    const std::size_t steps = std::min(count, most) - 1;
    for (std::size_t k = 1; k <= steps; ++k)
        numbers.push_back(k * (count - 1) / steps);
    return numbers;
}

}  // namespace

std::span<const Axis> accuracy_axes() { return catalog; }

const Axis& find_axis(std::string_view name) { return find_called(catalog, name, "axis"); }

void Axis::measure(const AxisRun& run) const
{
    if (measure_all != nullptr)
        return measure_all(run);
    std::vector<std::string> scenes = run.task.scenes;
    const bool may_stand_in = scenes.empty();  // what the user names is not replaced
    std::istringstream own(own_scenes);
    if (may_stand_in)
        scenes.assign(std::istream_iterator<std::string>(own), {});
    for (const std::string& scene : scenes) {
        run.progress.note("accuracy, " + std::string(name) + ": " + scene);
        SceneFacts facts{.name = scene};
        bool is_there = false;
        const std::string failure = reason_of_failure([&] {
            Scene there = scene_called(scene, may_stand_in, run.session.scenes());
            facts = facts_of(there, there.stand_in_for.empty() ? scene : there.name, 0);
            if (!by_objects)
                there = in_file_order(std::move(there));
            for (const std::size_t frame : spread(there.frames.size(), most_frames)) {
                facts.frame = static_cast<std::int64_t>(frame);
                const Input input = upload_frame(run.session, there, frame, by_objects);
                is_there = true;
                measure_frame(run, facts, input);
            }
        });
        if (failure.empty())
            continue;
        Cell all = accuracy_cell(name, "all", facts);
        run.engine().refuse(all, is_there ? Cell::Status::failed : Cell::Status::skipped, failure);
        run.add(std::move(all));
    }
}

Cell accuracy_cell(std::string_view axis, std::string_view method, SceneFacts input)
{
    return {.experiment = "accuracy",
            .scene = std::move(input),
            .builder = {.name = "none"},
            .accuracy = {.axis = std::string(axis), .method = std::string(method)},
            .operation = Operation::accuracy};
}

void judge(Cell& cell, std::string_view reference, bool must_be_right, const std::string& wrong)
{
    cell.check.against = reference;
    cell.check.detail = must_be_right ? wrong : "";
    cell.check.verdict = !must_be_right  ? Check::Verdict::counted
                         : wrong.empty() ? Check::Verdict::agrees
                                         : Check::Verdict::differs;
}

void judge_errors(Cell& cell, std::string_view reference, bool must_be_right)
{
    const auto count = [&](const char* name) {
        return static_cast<std::uint64_t>(cell.counters.at(name));
    };
    const Differences wrong{count("missed_count"), count("false_count")};
    judge(cell, reference, must_be_right, wrong == Differences{} ? "" : wrong.text());
}

void judge_contacts(Cell& cell, std::string_view reference, std::string_view narrow)
{
    const NarrowMethod* const method = narrow == "none" ? nullptr : &find_narrow_method(narrow);
    const bool misses = cell.counters.at("missed_count") > 0;
    judge_errors(
        cell, reference,
        method == nullptr ? misses : method->is_exact || (misses && method->misses_none()));
}

void measure_methods(const AxisRun& run, std::string_view axis, const SceneFacts& input,
                     std::span<const AxisMethod> methods)
{
    Engine engine = run.engine();
    std::vector<Measurement> measurements;
    measurements.reserve(methods.size());  // no reallocation: methods may keep references
    for (const AxisMethod& method : methods) {
        if (!run.task.wants(input.name, method.name))
            continue;
        Measurement& one = measurements.emplace_back();
        one.cell = accuracy_cell(axis, method.name, input);
        one.cell.builder = method.builder;
        one.cell.collider = method.collider;
        engine.prepare(one, [&] { method.prepare(one); });
    }
    for (Cell& cell : engine.sample(measurements))
        run.add(std::move(cell));
}

}  // namespace bvhbench
