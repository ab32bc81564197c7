// SPDX-License-Identifier: MIT
#include "harness/accuracy/axes.h"

#include "geometry/error.h"
#include "harness/accuracy/axis.h"
#include "harness/report.h"
#include "harness/sampler.h"

namespace bvhbench {
namespace {

// To add an axis, add its file and its line here.
constexpr Axis catalog[] = {
    {"narrow",
     "which narrow phase is wrong how often, on which pairs of triangles, and what it takes",
     measure_narrow, report_narrow},
    {"sums", "how far off is the surface area cost, by how areas are summed", measure_sums,
     report_sums},
    {"codes", "what do more bits a code and cubic cells buy: duplicates, tree, box tests",
     measure_codes, report_codes},
    {"input", "what does rounding vertices from doubles to floats add to the pairs of boxes",
     measure_input, report_input},
    {"boxes", "what do fewer bytes a box cost in false pairs and save in time", measure_boxes,
     report_boxes},
    {"swept",
     "who finds the pairs that may meet between two frames, how soon, and how many for each that "
     "does",
     measure_swept, report_swept},
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

std::string accuracy_report(const Document& document)
{
    std::string text;
    for (const Axis& axis : catalog)
        text += axis.report(document);
    return text;
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

void Measured::fail(Session& session, const std::string& why)
{
    session.renew_queue();
    once = nullptr;
    cell.status = Cell::Status::failed;
    cell.reason = why;
    cell.samples.clear();
}

void take_samples_of(const AxisRun& run, std::span<Measured> cells)
{
    constexpr int warm_up = 1;
    std::vector<Measured*> ready;
    std::vector<Timed> timed;
    for (Measured& one : cells)
        if (one.once) {
            ready.push_back(&one);
            timed.push_back({one.cell.accuracy.method, one.once});
        }
    std::vector<Taken> taken = take_samples(timed, run.task.samples, warm_up, run.order);
    for (std::size_t k = 0; k < ready.size(); ++k) {
        ready[k]->cell.warm_up = warm_up;
        ready[k]->cell.samples = std::move(taken[k].samples);
        if (!taken[k].failure.empty())
            ready[k]->fail(run.session, taken[k].failure);
    }
}

std::string why_text(const Cell& cell)
{
    const std::string why = cell.reason.empty() ? cell.check.detail : cell.reason;
    return verdict_text(cell) + (why.empty() ? "" : ": " + why.substr(0, why.find('\n')));
}

std::vector<const Cell*> cells_of(const Document& document, std::string_view axis)
{
    std::vector<const Cell*> cells;
    for (const Cell& cell : document.cells)
        if (cell.operation == Operation::accuracy && cell.accuracy.axis == axis)
            cells.push_back(&cell);
    return cells;
}

}  // namespace bvhbench
