// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <set>

#include "collide/narrow_methods.h"
#include "harness/accuracy/axes.h"
#include "harness/accuracy/axis.h"
#include "harness/report.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

using enum Table::Align;

constexpr std::string_view yardstick = "guigue-f64";

double ns_a_pair(const Cell& cell)
{
    return spread_of(whole_times_ns(cell)).median / cell.counters.at("pairs_count");
}

std::string count_text(const Cell& cell, const char* counter)
{
    return grouped(static_cast<std::int64_t>(cell.counters.at(counter)));
}

const Cell* yardstick_beside(const Cell& cell, const std::vector<const Cell*>& cells)
{
    for (const Cell* other : cells)
        if (other->scene.name == cell.scene.name && other->accuracy.method == yardstick &&
            has_times(*other))
            return other;
    return nullptr;
}

std::string percent_text(double part, double of)
{
    return of > 0 ? fixed(100 * part / of, 1) + " %" : "";
}

/// What a method got wrong over all classes.
struct Total {
    std::int64_t pairs = 0, missed = 0, false_ones = 0, classes = 0, wrong_classes = 0;
};

}  // namespace

std::string report_narrow(const Document& document)
{
    const std::vector<const Cell*> cells = cells_of(document, "narrow");
    Table table({{"pairs of triangles", left},
                 {"narrow phase", left},
                 {"pairs"},
                 {"meet"},
                 {"missed"},
                 {"false"},
                 {"exactly"},
                 {"ns/pair"},
                 {"of " + std::string(yardstick)},
                 {"verdict", left}});
    std::map<std::string, Total> totals;
    std::set<std::int64_t> seeds;
    for (const Cell* cell : cells) {
        if (cell->status != Cell::Status::measured) {
            table.row({cell->scene.name, cell->accuracy.method, "", "", "", "", "", "", "",
                       why_text(*cell)});
            continue;
        }
        const Cell* const beside = yardstick_beside(*cell, cells);
        const bool timed = has_times(*cell);
        table.row(
            {cell->scene.name, cell->accuracy.method, count_text(*cell, "pairs_count"),
             count_text(*cell, "meeting_count"), count_text(*cell, "missed_count"),
             count_text(*cell, "false_count"),
             percent_text(cell->counters.at("narrow_exact_count"),
                          cell->counters.at("pairs_count")),
             timed ? fixed(ns_a_pair(*cell), 2) : "",
             timed && beside != nullptr ? fixed(ns_a_pair(*cell) / ns_a_pair(*beside), 2) : "",
             verdict_text(*cell)});
        Total& total = totals[cell->accuracy.method];
        const auto missed = static_cast<std::int64_t>(cell->counters.at("missed_count"));
        const auto false_ones = static_cast<std::int64_t>(cell->counters.at("false_count"));
        total.pairs += static_cast<std::int64_t>(cell->counters.at("pairs_count"));
        total.missed += missed;
        total.false_ones += false_ones;
        ++total.classes;
        total.wrong_classes += missed + false_ones > 0 ? 1 : 0;
        seeds.insert(cell->accuracy.seed);
    }
    if (cells.empty())
        return {};
    std::string text = table.text();
    for (const NarrowMethod& method : narrow_methods())
        if (const auto at = totals.find(std::string(method.name)); at != totals.end())
            text += at->first + ": " + grouped(at->second.missed) + " missed and " +
                    grouped(at->second.false_ones) + " false of " + grouped(at->second.pairs) +
                    " pairs, wrong in " + std::to_string(at->second.wrong_classes) + " of " +
                    std::to_string(at->second.classes) + " classes\n";
    for (const std::int64_t seed : seeds)
        text += "seed " + std::to_string(seed) + '\n';
    return text;
}

}  // namespace bvhbench
