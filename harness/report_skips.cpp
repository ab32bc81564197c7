// SPDX-License-Identifier: MIT
#include "harness/report_skips.h"

#include <cmath>

#include "harness/report.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

using enum Table::Align;

/// The cell of the same frame and pipeline with one rule less switched off; nullptr if there is none.
const Cell* with_rule(const Cell& cell, unsigned rule, const Document& document)
{
    ColliderChoice wanted = cell.collider;
    wanted.rules_off &= ~rule;
    for (const Cell& other : document.cells)
        if (other.collider == wanted && other.builder == cell.builder &&
            other.scene.name == cell.scene.name && other.scene.frame == cell.scene.frame &&
            other.experiment == cell.experiment && other.operation == Operation::collide)
            return &other;
    return nullptr;
}

bool may_be_printed(const Cell& cell)
{
    return verdict_text(cell) == "agrees" && !cell.samples.empty();
}

int launches_of(const Cell& cell)
{
    int launches = 0;
    for (const StageTime& stage : cell.samples.front().stages)
        launches += stage.launches;
    return launches;
}

double counter(const Cell& cell, const char* key)
{
    const auto found = cell.counters.find(key);
    return found == cell.counters.end() ? 0 : found->second;
}

/// Triangles that the frame's work began with.
double entered(const Cell& cell)
{
    return cell.counters.contains("entered_count") ? counter(cell, "entered_count")
                                                   : static_cast<double>(cell.scene.triangles);
}

std::vector<std::string> row_of(const Cell& with, const Cell& without, std::string_view rule)
{
    const double on = spread_of(whole_times_ns(with)).median;
    const double off = spread_of(whole_times_ns(without)).median;
    const bool same = with.check.pairs_hash == without.check.pairs_hash &&
                      with.check.contacts_hash == without.check.contacts_hash;
    const auto less = [&](const char* key) {
        return static_cast<std::int64_t>(counter(without, key) - counter(with, key));
    };
    const auto triangles = static_cast<std::int64_t>(entered(without) - entered(with));
    const int launches = launches_of(without) - launches_of(with);
    const std::int64_t tasks = less("tasks_count"), tests = less("box_tests_count");
    const std::int64_t built = less("rebuilt_objects_count"), sorts = less("sorts_count");
    const std::int64_t touched = -less("kept_objects_count");
    std::vector<std::string> row = {with.scene.name,          std::to_string(with.scene.frame),
                                    std::string(rule),        grouped(triangles),
                                    std::to_string(launches), grouped(built),
                                    grouped(touched),         grouped(sorts),
                                    grouped(tasks),           grouped(tests)};
    // A group takes its nodes in the order in which they turn up: of its box tests a few in a million come and go.
    const bool few = 1000 * std::abs(static_cast<double>(tests)) < counter(with, "box_tests_count");
    if (triangles == 0 && launches == 0 && built == 0 && touched == 0 && sorts == 0 && tasks == 0 &&
        few)
        row.insert(row.end(), {"", "", "nothing to skip"});  // its times would be noise
    else
        row.insert(row.end(), {duration_text(on), duration_text(off), fixed(off / on, 2)});
    row.push_back(same ? "the same" : "NOT the same");
    return row;
}

}  // namespace

std::string skips_report(const Document& document)
{
    Table table({{"scene", left},
                 {"frame"},
                 {"rule", left},
                 {"triangles left out"},
                 {"launches"},
                 {"rebuilds"},
                 {"updates"},
                 {"sorts"},
                 {"tasks"},
                 {"box tests"},
                 {"with"},
                 {"without"},
                 {"times"},
                 {"pairs", left}});
    bool is_empty = true;
    for (const Cell& cell : document.cells)
        for (const SkipRuleEntry& entry : skip_rules()) {
            if ((cell.collider.rules_off & entry.rule) == 0)
                continue;
            const Cell* with = with_rule(cell, entry.rule, document);
            if (with == nullptr || !may_be_printed(cell) || !may_be_printed(*with))
                continue;
            table.row(row_of(*with, cell, entry.name));
            is_empty = false;
        }
    return is_empty ? std::string() : "skips:\n" + table.text();
}

}  // namespace bvhbench
