// SPDX-License-Identifier: MIT
#include "harness/smoke.h"

#include <algorithm>

#include "geometry/hash.h"
#include "harness/build_info.h"
#include "harness/catalog.h"
#include "harness/cell_identity.h"
#include "harness/collider_catalog.h"
#include "harness/exact_counters.h"
#include "harness/number_text.h"
#include "harness/report.h"
#include "harness/statistics.h"

namespace bvhbench {
namespace {

constexpr double least_excess_ns = 50'000;  ///< below which a ratio says nothing: some launches

bool is_library(const Cell& cell)
{
    return (!cell.collider.name.empty() && find_collider(cell.collider.name).is_library) ||
           (cell.builder.name != "none" && find_builder(cell.builder.name).is_library);
}

/// Host stages and libraries scale with other things than a device's.
bool has_device_time(const Cell& cell)
{
    return has_times(cell) && !is_library(cell) &&
           std::all_of(cell.samples.front().stages.begin(), cell.samples.front().stages.end(),
                       [](const StageTime& stage) { return stage.wall_ns == 0; });
}

/// Of all samples: a machine that does other work makes none faster, and many slower.
double fastest_ns(const Cell& cell)
{
    const std::vector<double> times = whole_times_ns(cell);
    return *std::min_element(times.begin(), times.end());
}

std::map<std::string, std::string> hashes_of(const Cell& cell)
{
    std::map<std::string, std::string> hashes;
    if (cell.check.tree_hash && !is_library(cell))
        hashes["tree"] = hex(*cell.check.tree_hash);
    if (cell.check.pairs_hash)
        hashes["pairs"] = hex(*cell.check.pairs_hash);
    if (cell.check.contacts_hash)
        hashes["contacts"] = hex(*cell.check.contacts_hash);
    return hashes;
}

const SmokeCell* find(const SmokeBaseline& baseline, const std::string& name)
{
    const auto found = std::find_if(baseline.cells.begin(), baseline.cells.end(),
                                    [&](const SmokeCell& cell) { return cell.name == name; });
    return found == baseline.cells.end() ? nullptr : &*found;
}

/// Whether the answer is at least as well known to be right.
int rank_of(const std::string& verdict)
{
    constexpr std::string_view from_worst[] = {"failed",      "differs", "skipped",
                                               "not checked", "counted", "agrees"};
    return static_cast<int>(std::find(std::begin(from_worst), std::end(from_worst), verdict) -
                            std::begin(from_worst));
}

void compare_facts(const SmokeCell& before, const SmokeCell& now, SmokeResult& result)
{
    const auto tell = [&](const std::string& what) {
        result.regressions.push_back(now.name + ": " + what);
    };
    if (rank_of(now.verdict) < rank_of(before.verdict))
        tell(now.verdict + ", was " + before.verdict);
    else if (now.verdict != before.verdict)
        result.remarks.push_back(now.name + ": " + now.verdict + ", was " + before.verdict);
    if (rank_of(now.verdict) <= rank_of("skipped") || rank_of(before.verdict) <= rank_of("skipped"))
        return;
    for (const auto& [counter, value] : before.counters) {
        const auto other = now.counters.find(counter);
        if (other == now.counters.end())
            tell("no " + counter + ", was " + number_text(value));
        else if (other->second != value)
            tell(counter + ' ' + number_text(other->second) + ", was " + number_text(value));
    }
    for (const auto& [counter, value] : now.counters)
        if (!before.counters.contains(counter))
            tell(counter + " is new: " + number_text(value));
    for (const auto& [what, hash] : before.hashes) {
        const auto other = now.hashes.find(what);
        if (other == now.hashes.end() || other->second != hash)
            tell("other " + what + " than before: hash " +
                 (other == now.hashes.end() ? "none" : other->second) + ", was " + hash);
    }
}

void compare_times(const SmokeBaseline& before, const SmokeBaseline& now, double tolerance,
                   SmokeResult& result)
{
    std::map<std::string, std::vector<std::pair<const SmokeCell*, const SmokeCell*>>> scenes;
    for (const SmokeCell& cell : now.cells)
        if (const SmokeCell* old = find(before, cell.name);
            old != nullptr && old->fastest_ns > 0 && cell.fastest_ns > 0)
            scenes[cell.scene].emplace_back(old, &cell);
    for (const auto& [scene, cells] : scenes) {
        std::vector<double> ratios;
        for (const auto& [old, cell] : cells)
            ratios.push_back(cell->fastest_ns / old->fastest_ns);
        const double common = quantile(ratios, 0.5);
        for (const auto& [old, cell] : cells) {
            ++result.timed;
            const double expected = old->fastest_ns * common;
            if (cell->fastest_ns > tolerance * expected &&
                cell->fastest_ns > expected + least_excess_ns)
                result.regressions.push_back(
                    cell->name + ": takes " +
                    number_text(std::round(10 * cell->fastest_ns / expected) / 10) +
                    " times as long beside the others of its scene as it did");
        }
    }
}

}  // namespace

std::map<std::string, double> machine_independent_counters(const Cell& cell)
{
    std::map<std::string, double> kept;
    for (const auto& [counter, value] : cell.counters) {
        const bool is_found = counter == "pairs_count" || counter == "contacts_count";
        if (is_exact(counter, cell) && !depends_on_machine(counter) &&
            (is_found || !is_library(cell)))
            kept[counter] = value;
    }
    return kept;
}

SmokeBaseline smoke_baseline(const Document& document)
{
    SmokeBaseline baseline{.device_kind = document.run.device.kind, .cells = {}};
    for (const Cell& cell : document.cells)
        baseline.cells.push_back(
            {.name = cell_label(cell),
             .scene = cell.scene.name + ' ' + std::string(operation_name(cell.operation)),
             .verdict = verdict_text(cell),
             .counters = machine_independent_counters(cell),
             .hashes = hashes_of(cell),
             .fastest_ns = has_device_time(cell) ? std::round(fastest_ns(cell)) : 0});
    return baseline;
}

SmokeResult compare_smoke(const SmokeBaseline& before, const SmokeBaseline& now, double tolerance,
                          bool some)
{
    SmokeResult result;
    for (const SmokeCell& cell : now.cells)
        if (const SmokeCell* old = find(before, cell.name)) {
            ++result.compared;
            compare_facts(*old, cell, result);
        } else {
            result.regressions.push_back(cell.name + ": is not in the baseline");
        }
    for (const SmokeCell& old : before.cells)
        if (!some && find(now, old.name) == nullptr)
            result.regressions.push_back(old.name + ": is in the baseline only");
    compare_times(before, now, tolerance, result);
    return result;
}

std::filesystem::path smoke_path(const std::string& device_kind)
{
    return std::filesystem::path(build_info.source_root) / "results/baseline" /
           ("smoke-" + device_kind + ".json");
}

}  // namespace bvhbench
