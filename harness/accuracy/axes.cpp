// SPDX-License-Identifier: MIT
#include "harness/accuracy/axes.h"

#include "geometry/error.h"
#include "harness/accuracy/axis.h"

namespace bvhbench {
namespace {

// To add an axis, add its file and its line here.
constexpr Axis catalog[] = {
    {"narrow", "which narrow phase is wrong how often, on which pairs of triangles, and what it takes",
     measure_narrow, report_narrow},
    {"sums", "how far off is the surface area cost, by how areas are summed", measure_sums, report_sums},
    {"codes", "what do more bits a code and cubic cells buy: duplicates, tree, box tests",
     measure_codes, report_codes},
    {"input", "what does rounding vertices from doubles to floats add to the pairs of boxes",
     measure_input, report_input},
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
    return !filter || std::regex_search(std::string(input) + '/' + std::string(method), *filter);
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

std::vector<const Cell*> cells_of(const Document& document, std::string_view axis)
{
    std::vector<const Cell*> cells;
    for (const Cell& cell : document.cells)
        if (cell.operation == Operation::accuracy && cell.accuracy.axis == axis)
            cells.push_back(&cell);
    return cells;
}

}  // namespace bvhbench
