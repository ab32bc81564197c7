// SPDX-License-Identifier: MIT
//
// What of two cells is no time, and what of two runs must be the same before anything is compared.
#include "harness/compare_facts.h"

#include "geometry/error.h"
#include "geometry/hash.h"
#include "harness/compare.h"
#include "harness/exact_counters.h"
#include "harness/number_text.h"
#include "harness/report.h"

namespace bvhbench {
namespace {

/// The higher, the better.
int rank_of(const Cell& cell)
{
    if (cell.status != Cell::Status::measured)
        return cell.status == Cell::Status::skipped ? -1 : -2;
    switch (cell.check.verdict) {
        case Check::Verdict::agrees:
            return 3;
        case Check::Verdict::counted:
            return 2;
        case Check::Verdict::not_checked:
            return 1;
        default:
            return 0;
    }
}

void compare_verdicts(const Cell& first, const Cell& second, FactChanges& found)
{
    if (rank_of(first) == rank_of(second))
        return;
    std::string text = verdict_text(second);
    const std::string& why = second.reason.empty() ? second.check.detail : second.reason;
    if (!why.empty())
        text += " (" + why + ')';
    (rank_of(second) < rank_of(first) ? found.regressions : found.changes)
        .push_back(text + ", was " + verdict_text(first));
}

void compare_hashes(const Check& first, const Check& second, FactChanges& found)
{
    const auto differ = [](const auto& one, const auto& other) {
        return one && other && *one != *other;
    };
    if (differ(first.pairs_hash, second.pairs_hash))
        found.regressions.push_back("other pairs: " + hex(*second.pairs_hash) + ", were " +
                                    hex(*first.pairs_hash));
    if (differ(first.contacts_hash, second.contacts_hash))
        found.regressions.push_back("other contacts: " + hex(*second.contacts_hash) + ", were " +
                                    hex(*first.contacts_hash));
    if (differ(first.tree_hash, second.tree_hash))
        found.changes.push_back("another tree: " + hex(*second.tree_hash) + ", was " +
                                hex(*first.tree_hash));
}

void compare_counters(const Cell& first, const Cell& second, bool allow_missing, FactChanges& found)
{
    for (const auto& [counter, value] : first.counters) {
        const auto other = second.counters.find(counter);
        if (other == second.counters.end()) {
            const auto why = second.left_out.find(counter);
            (allow_missing ? found.changes : found.regressions)
                .push_back("no " + counter +
                           (why == second.left_out.end() ? "" : " (" + why->second + ')') +
                           ", was " + number_text(value));
        } else if (other->second != value && is_exact(counter, first)) {
            const bool is_better = is_better_smaller(counter) && other->second < value;
            (is_better ? found.changes : found.regressions)
                .push_back(counter + ' ' + number_text(other->second) + ", was " +
                           number_text(value));
        }
    }
    if (!first.leaves_by_depth.empty() && !second.leaves_by_depth.empty() &&
        first.leaves_by_depth != second.leaves_by_depth)
        found.changes.push_back("leaves by depth " + depths_text(second.leaves_by_depth) +
                                ", were " + depths_text(first.leaves_by_depth));
}

bool tells_starts(const Document& document) { return document.minor >= 4; }

bool same_device(const RunFacts& one, const RunFacts& other)
{
    return one.device.name == other.device.name && one.device.platform == other.device.platform &&
           one.device.compute_units == other.device.compute_units &&
           one.host_cpu == other.host_cpu && one.host_threads == other.host_threads;
}

std::string device_text(const RunFacts& run)
{
    return run.device.name + " (" + std::to_string(run.device.compute_units) + " units, host " +
           run.host_cpu + " of " + std::to_string(run.host_threads) + " threads)";
}

void require_file(const Document& document, const std::string& name, const CompareRules& rules)
{
    if (document.cells.empty())
        throw BadUsage(name + " has no cells to compare");
    if (document.run.dirty && !rules.allow_dirty)
        throw BadUsage(name +
                       " was made by a program with changes that no commit has, so nobody can say "
                       "what was compared; --allow-dirty compares it all the same");
    if (!document.run.test_hooks.empty() && !rules.allow_test_hooks)
        throw BadUsage(name + " was made under " + document.run.test_hooks.begin()->first + '=' +
                       document.run.test_hooks.begin()->second +
                       ", which changes times for tests: it is no result");
}

}  // namespace

FactChanges fact_changes(const Cell& first, const Cell& second, const CompareRules& rules)
{
    FactChanges found;
    compare_verdicts(first, second, found);
    if (first.status != Cell::Status::measured || second.status != Cell::Status::measured)
        return found;
    if (first.scene.content_hash != second.scene.content_hash) {
        found.regressions.push_back("another scene of the same name: content " +
                                    hex(second.scene.content_hash) + ", was " +
                                    hex(first.scene.content_hash));
        return found;
    }
    if (rules.other_devices)
        return found;
    compare_hashes(first.check, second.check, found);
    compare_counters(first, second, rules.allow_missing, found);
    return found;
}

std::vector<std::string> run_remarks(const RunFacts& first, const RunFacts& second)
{
    std::vector<std::string> remarks;
    const auto compare = [&](const char* what, const std::string& one, const std::string& other) {
        if (one != other)
            remarks.push_back(std::string(what) + ": " + one + " and " + other);
    };
    compare("device", first.device.name, second.device.name);
    compare("driver", first.device.driver, second.device.driver);
    compare("host", first.host_name, second.host_name);
    compare("operating system", first.host_os, second.host_os);
    compare("compiler", first.compiler, second.compiler);
    compare("build", first.build_type, second.build_type);
    compare("architecture", first.arch, second.arch);
    compare("kernels", first.kernels, second.kernels);
    if (first.tuning != second.tuning)
        remarks.push_back("tuned values");
    for (const auto& [which, run] : {std::pair{"first", &first}, {"second", &second}}) {
        if (run->finished_at.empty())
            remarks.push_back(std::string("the ") + which + " run was stopped before its end");
        for (const auto& [hook, value] : run->test_hooks)
            remarks.push_back(std::string("the ") + which + " run was under " + hook + '=' + value);
    }
    return remarks;
}

void require_comparable(const Document& first, const std::string& first_name,
                        const Document& second, const std::string& second_name,
                        const CompareRules& rules)
{
    require_file(first, first_name, rules);
    require_file(second, second_name, rules);
    if (tells_starts(first) != tells_starts(second))
        throw BadUsage(first_name + " has format 1." + std::to_string(first.minor) + " and " +
                       second_name + " 1." + std::to_string(second.minor) +
                       ": before 1.4 the time of a frame is another, without the gaps between "
                       "stages");
    if (first.run.costs != second.run.costs)
        throw BadUsage(first_name + " counts " + costs_text(first.run.costs) + " and " +
                       second_name + ' ' + costs_text(second.run.costs) +
                       ", so their sah_cost are not of one kind");
    if (!rules.other_devices && !same_device(first.run, second.run))
        throw BadUsage(first_name + " was measured on " + device_text(first.run) + " and " +
                       second_name + " on " + device_text(second.run) +
                       "; --other-devices compares only ratios between the cells of a scene");
}

}  // namespace bvhbench
