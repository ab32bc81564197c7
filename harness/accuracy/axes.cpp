// SPDX-License-Identifier: MIT
#include "harness/accuracy/axes.h"

#include "geometry/error.h"
#include "harness/accuracy/axis.h"

namespace bvhbench {
namespace {

// To add an axis, add its file and its line here.
constexpr Axis catalog[] = {
    {"narrow",
     "which narrow phase is wrong how often, on which pairs of triangles, and what it takes",
     measure_narrow},
    {"sums", "how far off is the surface area cost, by how areas are summed", measure_sums},
    {"codes", "what do more bits a code and cubic cells buy: duplicates, tree, box tests",
     measure_codes},
    {"input", "what does rounding vertices from doubles to floats add to the pairs of boxes",
     measure_input},
    {"boxes", "what do fewer bytes a box cost in false pairs and save in time", measure_boxes},
    {"swept",
     "who finds the pairs that may meet between two frames, how soon, and how many for each that "
     "does",
     measure_swept},
};

}  // namespace

std::span<const Axis> accuracy_axes() { return catalog; }

const Axis& find_axis(std::string_view name)
{
    std::string known;
    for (const Axis& axis : catalog) {
        if (axis.name == name)
            return axis;
        known += (known.empty() ? " " : ", ") + std::string(axis.name);
    }
    throw BadUsage("no axis is called '" + std::string(name) + "'; there are:" + known);
}

bool AxisTask::wants(std::string_view input, std::string_view method) const
{
    return !filter || filter->is_in(std::string(input) + '/' + std::string(method));
}

Cell accuracy_cell(std::string axis, std::string method, SceneFacts input)
{
    Cell cell;
    cell.experiment = "accuracy";
    cell.scene = std::move(input);
    cell.builder = {.name = "none"};
    cell.accuracy = {.axis = std::move(axis), .method = std::move(method)};
    cell.operation = Operation::accuracy;
    return cell;
}

void fail(Session& session, Subject& subject, const std::string& why)
{
    int order = 0;
    Engine(session, {}, order).refuse(subject, Cell::Status::failed, why);
    subject.once = nullptr;
}

void take_samples_of(const AxisRun& run, std::span<Subject> cells)
{
    Engine(run.session, {.samples = run.task.samples, .warm_up = 1}, run.order).sample(cells);
    for (Subject& cell : cells)
        if (cell.cell.status != Cell::Status::measured)
            cell.once = nullptr;
}

}  // namespace bvhbench
