// SPDX-License-Identifier: MIT
#include "harness/report_refit.h"

#include "harness/report.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

using enum Table::Align;

/// Medians of one cell.
struct Times {
    double whole = 0;
    double last = 0;  ///< of the stage that makes the boxes
};

Times times_of(const Cell& cell, std::string_view last_stage)
{
    return {spread_of(whole_times_ns(cell)).median,
            spread_of(stage_times_ns(cell, last_stage)).median};
}

bool may_be_printed(const Cell& cell)
{
    return verdict_text(cell) == "agrees" && !cell.samples.empty();
}

/// The rebuild of the same tree's builder on the same scene; nullptr if there is none to print.
const Cell* rebuild_beside(const Cell& refit, const Document& document)
{
    for (const Cell& cell : document.cells)
        if (cell.operation == Operation::build && cell.builder == refit.builder &&
            cell.scene.name == refit.scene.name && cell.experiment == refit.experiment &&
            may_be_printed(cell))
            return &cell;
    return nullptr;
}

std::string ratio_text(double rebuild, double refit)
{
    return rebuild > 0 && refit > 0 ? fixed(rebuild / refit, 2) : "";
}

std::string cost_text(const Cell& cell)
{
    const auto found = cell.counters.find("sah_cost");
    return found == cell.counters.end() ? "" : fixed(found->second, 2);
}

}  // namespace

std::string refit_report(const Document& document)
{
    Table table({{"scene", left},
                 {"triangles"},
                 {"builder", left},
                 {"rebuild"},
                 {"refit"},
                 {"times"},
                 {"hierarchy"},
                 {"refit stage"},
                 {"times"},
                 {"SAH rebuilt"},
                 {"refitted"}});
    int pairs = 0, slower = 0;
    for (const Cell& cell : document.cells) {
        if (cell.operation != Operation::refit || !may_be_printed(cell))
            continue;
        const Cell* const beside = rebuild_beside(cell, document);
        if (beside == nullptr)
            continue;
        const Times rebuild = times_of(*beside, "hierarchy");
        const Times refit = times_of(cell, "refit");
        ++pairs;
        slower += rebuild.whole > refit.whole ? 1 : 0;
        table.row({cell.scene.name, grouped(cell.scene.triangles), variant_text(cell.builder),
                   duration_text(rebuild.whole), duration_text(refit.whole),
                   ratio_text(rebuild.whole, refit.whole), duration_text(rebuild.last),
                   duration_text(refit.last), ratio_text(rebuild.last, refit.last),
                   cost_text(*beside), cost_text(cell)});
    }
    if (pairs == 0)
        return {};
    return table.text() +
           "medians; rebuild and refit: from moved triangles to a tree over them, all stages; "
           "times: rebuild over refit\n"
           "rebuilding takes longer than refitting in " +
           std::to_string(slower) + " of " + std::to_string(pairs) + " cases\n";
}

}  // namespace bvhbench
