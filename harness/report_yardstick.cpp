// SPDX-License-Identifier: MIT
#include "harness/report_yardstick.h"

#include <algorithm>

#include "harness/report.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

using enum Table::Align;

constexpr std::string_view yardstick = "oibvh-host";

bool may_be_printed(const Cell& cell)
{
    return cell.operation == Operation::build && verdict_text(cell) == "agrees" &&
           !cell.samples.empty();
}

/// The yardstick's cell with the same tree on the same scene; nullptr if there is none to print.
const Cell* yardstick_beside(const Cell& cell, const Document& document)
{
    for (const Cell& other : document.cells)
        if (other.builder.name == yardstick && may_be_printed(other) &&
            other.experiment == cell.experiment && other.scene.name == cell.scene.name &&
            other.builder.sorted_leaves == cell.builder.sorted_leaves &&
            other.check.tree_hash == cell.check.tree_hash)
            return &other;
    return nullptr;
}

double hierarchy_ns(const Cell& cell)
{
    return spread_of(stage_times_ns(cell, "hierarchy")).median;
}

}  // namespace

std::string yardstick_report(const Document& document)
{
    Table table({{"scene", left},
                 {"triangles"},
                 {"builder", left},
                 {"hierarchy"},
                 {std::string(yardstick)},
                 {"times"}});
    double most = 0;
    for (const Cell& cell : document.cells) {
        const Cell* const beside = may_be_printed(cell) && cell.builder.name != yardstick
                                       ? yardstick_beside(cell, document)
                                       : nullptr;
        if (beside == nullptr)
            continue;
        const double times = hierarchy_ns(cell) / hierarchy_ns(*beside);
        most = std::max(most, times);
        table.row({cell.scene.name, grouped(cell.scene.triangles), variant_text(cell.builder),
                   duration_text(hierarchy_ns(cell)), duration_text(hierarchy_ns(*beside)),
                   fixed(times, 2)});
    }
    if (most == 0)
        return {};
    return table.text() + "medians of the stage hierarchy, of trees that are equal: at most " +
           fixed(most, 2) + " times as long as by threads of the host\n";
}

}  // namespace bvhbench
