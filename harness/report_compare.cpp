// SPDX-License-Identifier: MIT
#include "harness/report_compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "harness/cell_identity.h"
#include "harness/report.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

using enum Table::Align;

std::string p_text(double p)
{
    char text[32];
    std::snprintf(text, sizeof text, p < 0.001 ? "%.0e" : "%.3f", p);
    return text;
}

std::string ends_text(const Interval& ratio)
{
    return std::isfinite(ratio.high) && ratio.low > 0
               ? fixed(ratio.low, 3) + " – " + fixed(ratio.high, 3)
               : "too few";
}

std::string counts_text(const TimeChange& change)
{
    const std::string first = std::to_string(change.first_count);
    return change.first_count == change.second_count
               ? first
               : first + "/" + std::to_string(change.second_count);
}

std::vector<std::string> row_of(const std::string& name, const TimeChange& change, bool decides)
{
    return {name,
            duration_text(change.first.value),
            duration_text(change.second.value),
            change.first.value > 0 ? fixed(change.second.value / change.first.value, 3) : "",
            fixed(change.ratio.value, 3),
            ends_text(change.ratio),
            p_text(change.p),
            counts_text(change),
            decides ? std::string(time_verdict_text(change.verdict)) : ""};
}

/// How far the times are apart, in whichever direction counts as bad first.
double badness(const ComparedCell& cell) { return cell.time.ratio.value; }

int place(const ComparedCell& cell)
{
    switch (cell.time.verdict) {
        case TimeVerdict::slower:
            return 0;
        case TimeVerdict::unsure:
            return 1;
        case TimeVerdict::faster:
            return 2;
        default:
            return 3;
    }
}

bool is_timed(const ComparedCell& cell) { return cell.time.first_count > 0; }

/// Whether an unsure cell's median has moved so far that somebody would want to know.
bool is_notable(const ComparedCell& cell, double threshold)
{
    const double ratio = cell.time.ratio.value;
    return cell.time.verdict == TimeVerdict::faster || cell.time.verdict == TimeVerdict::slower ||
           (cell.time.verdict == TimeVerdict::unsure &&
            (ratio >= 1 + threshold || ratio <= 1 / (1 + threshold)));
}

std::string times_table(const Comparison& comparison, bool all)
{
    std::vector<const ComparedCell*> shown;
    for (const ComparedCell& cell : comparison.cells)
        if (is_timed(cell) && (all || is_notable(cell, comparison.rules.threshold)))
            shown.push_back(&cell);
    if (shown.empty() && comparison.scenes.empty())
        return {};
    std::stable_sort(shown.begin(), shown.end(), [](const auto* one, const auto* other) {
        return std::pair(place(*one), -badness(*one)) < std::pair(place(*other), -badness(*other));
    });
    Table table(
        {{"cell", left}, {"A"}, {"B"}, {"B/A"}, {"own"}, {"between"}, {"p"}, {"n"}, {"", left}});
    for (const ComparedCell* cell : shown) {
        table.row(row_of(cell_label(*cell->first), cell->time, true));
        for (const auto& [stage, change] : cell->stages)
            table.row(row_of("  " + stage, change, false));
    }
    for (const SceneChange& scene : comparison.scenes)
        table.row({scene.scene->scene.name + ": " + std::to_string(scene.cells) + ' ' +
                       std::string(operation_name(scene.scene->operation)) + " cells together",
                   "", "", fixed(scene.ratio.value, 3), "", ends_text(scene.ratio), "", "",
                   std::string(time_verdict_text(scene.verdict))});
    return table.text();
}

std::string changes_text(const Comparison& comparison)
{
    std::string text;
    for (const ComparedCell& cell : comparison.cells)
        for (const std::string& regression : cell.regressions)
            text += "REGRESSION " + cell_label(*cell.first) + ": " + regression + '\n';
    for (const Cell* cell : comparison.only_first)
        text += std::string(comparison.rules.allow_missing ? "" : "REGRESSION ") +
                cell_label(*cell) + ": not in B\n";
    for (const ComparedCell& cell : comparison.cells)
        for (const std::string& change : cell.changes)
            text += "changed " + cell_label(*cell.first) + ": " + change + '\n';
    for (const Cell* cell : comparison.only_second)
        text += "new " + cell_label(*cell) + ": only in B\n";
    return text;
}

std::string summary(const Comparison& comparison)
{
    std::size_t counts[4] = {};
    std::size_t regressions = comparison.rules.allow_missing ? 0 : comparison.only_first.size();
    std::size_t short_ones = 0;
    for (const ComparedCell& cell : comparison.cells) {
        ++counts[static_cast<std::size_t>(cell.time.verdict)];
        regressions += cell.is_regression() ? 1 : 0;
        short_ones += is_timed(cell) && std::min(cell.time.first_count, cell.time.second_count) <
                                            fewest_samples
                          ? 1
                          : 0;
    }
    for (const SceneChange& scene : comparison.scenes)
        regressions += scene.verdict == TimeVerdict::slower ? 1 : 0;
    std::string text = std::to_string(comparison.cells.size()) + " cells: ";
    for (const TimeVerdict verdict :
         {TimeVerdict::same, TimeVerdict::faster, TimeVerdict::slower, TimeVerdict::unsure})
        text += std::to_string(counts[static_cast<std::size_t>(verdict)]) + ' ' +
                std::string(time_verdict_text(verdict)) +
                (verdict == TimeVerdict::unsure ? "" : ", ");
    text += " at " + fixed(100 * comparison.rules.threshold, 1) + " %";
    if (short_ones > 0)
        text += "; " + std::to_string(short_ones) + " have fewer than " +
                std::to_string(fewest_samples) + " samples";
    return text + "\n" +
           (regressions == 0   ? "no regression\n"
            : regressions == 1 ? "1 regression\n"
                               : std::to_string(regressions) + " regressions\n");
}

}  // namespace

std::string comparison_report(const Comparison& comparison, bool all)
{
    std::string text;
    for (const std::string& remark : comparison.remarks)
        text += "not the same: " + remark + '\n';
    if (comparison.rules.other_devices)
        text += "ratios are of the median ratio of their scene: only how cells relate counts\n";
    return text + times_table(comparison, all) + changes_text(comparison) + summary(comparison);
}

}  // namespace bvhbench
