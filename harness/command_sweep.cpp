// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iostream>
#include <set>

#include "geometry/error.h"
#include "harness/commands.h"
#include "harness/interrupt.h"
#include "harness/merge.h"
#include "harness/provenance.h"
#include "harness/report.h"
#include "harness/result_file.h"
#include "harness/run.h"
#include "harness/session.h"
#include "harness/sweep/described.h"
#include "harness/sweep/facts_worker.h"
#include "harness/sweep/run.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

/// What decides what is measured besides cells, program and device. Limits do not, nor where data is.
std::string settings_of(const SweepCommand& command, const CommonOptions& common)
{
    return common.doubles + '\n' + costs_text(command.costs);
}

/// A device a process.
std::vector<std::string> devices_of(const SweepCommand& command, const CommonOptions& common)
{
    std::vector<std::string> named = command.devices;
    if (named.empty())
        named.push_back(common.device);
    std::vector<std::string> devices;
    const std::size_t jobs = command.jobs > 0 ? command.jobs : named.size();
    for (std::size_t i = 0; i < jobs; ++i)
        devices.push_back(named[i % named.size()]);
    return devices;
}

/// Of the devices, which must be one kind: of the first, whose run this is.
RunFacts facts_of(const std::vector<std::string>& devices, const Options& options,
                  const NodeCosts& costs)
{
    RunFacts facts = facts_of_device(options.common, devices.front());
    for (const std::string& device : std::set<std::string>(devices.begin(), devices.end())) {
        const RunFacts other =
            device == devices.front() ? facts : facts_of_device(options.common, device);
        if (device_words(other) != device_words(facts))
            throw BadUsage("the devices of a sweep must be alike, and these are " +
                           device_words(facts) + " and " + device_words(other) +
                           "; sweep each by itself, and merge --other-devices");
    }
    facts.command = options.words;
    facts.command.front() = std::filesystem::path(facts.command.front()).filename().string();
    facts.costs = costs;
    return facts;
}

void print_cells(const Sweep& sweep, const std::vector<SweepUnit>& units,
                 const std::vector<unsigned>& shards, const Shard& shard)
{
    using enum Table::Align;
    Table table({{"scene", left}, {"triangles"}, {"what", left}, {"shard"}, {"", left}});
    for (std::size_t i = 0; i < units.size(); ++i)
        if (shard.is_all() || shards[i] == shard.number)
            for (const SweepCell& cell : units[i].cells)
                table.row({cell.scene_name(), cell.triangles > 0 ? grouped(cell.triangles) : "",
                           pipeline_text(record_of(sweep, cell)),
                           shard.is_all() ? "" : std::to_string(shards[i])});
    for (const SweepCell& cell : sweep.cells)
        if (!cell.why_not.empty() && shard.number == 1)
            table.row({cell.scene_name(), cell.triangles > 0 ? grouped(cell.triangles) : "",
                       pipeline_text(record_of(sweep, cell)), "", "cannot be: " + cell.why_not});
    std::cout << table.text();
}

/// All that is done of the units, as one file whose run is the sweep's.
Merged assembled(const Sweep& sweep, const std::vector<SweepUnit>& units, const Shard& shard,
                 const SweepFolder& folder, const Output& output, RunFacts facts)
{
    std::vector<MergePart> parts(1);  // the first gives the file its run, and is written below
    bool all = true;
    for (const SweepUnit& unit : units) {
        const auto file = folder.done(unit);
        all = all && file;
        if (file)
            parts.push_back({file->string(), file_text(*file, "the cell's file")});
    }
    if (all)
        facts.finished_at = utc_now();
    std::vector<std::string> skipped;
    for (const SweepCell& one : sweep.cells) {
        if (one.why_not.empty() || shard.number != 1)
            continue;
        Cell cell = record_of(sweep, one);
        cell.status = Cell::Status::skipped;
        cell.reason = one.why_not;
        skipped.push_back(cell_text(cell));
    }
    const std::string run = run_text(facts);
    parts.front() = {"the sweep", document_text(run, {})};
    parts.push_back({"the sweep", document_text(run, skipped)});
    const Merged merged = merge(parts, {.other_commits = true});
    output.replace(merged.text);
    return merged;
}

std::string counts_text(const Document& document)
{
    std::size_t measured = 0, skipped = 0;
    for (const Cell& cell : document.cells) {
        measured += cell.status == Cell::Status::measured ? 1 : 0;
        skipped += cell.status == Cell::Status::skipped ? 1 : 0;
    }
    const auto number = [](std::size_t count) { return grouped(static_cast<std::int64_t>(count)); };
    const std::size_t all = document.cells.size();
    return counted(all, "cell") + ": " + number(measured) + " measured, " + number(skipped) +
           " skipped, " + number(all - measured - skipped) + " failed";
}

std::size_t cells_in(const std::vector<SweepUnit>& units)
{
    std::size_t cells = 0;
    for (const SweepUnit& unit : units)
        cells += unit.cells.size();
    return cells;
}

/// Says it on stdout, at once: cluster logs are read while they grow.
void say(const std::string& line) { std::cout << line << std::endl; }

SweepTask task_of(const SweepCommand& command, const CommonOptions& common)
{
    return {.devices = devices_of(command, common),
            .costs = command.costs,
            .cell_limit_s = command.cell_limit_s,
            .retry_failed = command.retry_failed,
            .tell = say};
}

bool disturb_each_other(const std::vector<std::string>& devices, const RunFacts& facts)
{
    return devices.size() > 1 && (facts.device.kind == "cpu" ||
                                  std::set(devices.begin(), devices.end()).size() < devices.size());
}

/// What the sweep may replace: a file of its own cells, which it wrote before. It reads its description and its scenes.
OutputRules rules_of(const SweepCommand& command, const Options& options, const Sweep& sweep)
{
    OutputRules rules{.force = options.common.force, .inputs = {command.file}};
    const SceneLibrary library = scene_library(options.common);
    std::set<std::string> scenes;
    for (const SweepCell& cell : sweep.cells)
        scenes.insert(cell.scene_name());
    for (const std::string& scene : scenes)
        for (std::string& file : scene_files(scene, library))
            rules.inputs.push_back(std::move(file));
    rules.may_replace = [&sweep](const std::string& text) {
        try {
            const Document document = read_document(text, "the result file");
            return std::all_of(document.cells.begin(), document.cells.end(),
                               [&](const Cell& cell) { return cell.experiment == sweep.name; });
        } catch (const Unavailable&) {
            return false;
        }
    };
    return rules;
}

/// Returns the exit code.
int measure(const SweepCommand& command, const Options& options, const Sweep& sweep,
            const std::vector<SweepUnit>& all, const std::vector<SweepUnit>& units,
            const Shard& shard)
{
    const SweepTask task = task_of(command, options.common);
    const RunFacts facts = facts_of(task.devices, options, command.costs);
    const SweepFolder folder(command.out, sweep, command.together == "scene", all, shard, facts,
                             command.continue_other_commit);
    const Output output(folder.result_file(), "--out", rules_of(command, options, sweep));
    if (disturb_each_other(task.devices, facts))
        say("note: processes share a device, and disturb each other's times");
    if (!folder.note().empty())
        say(folder.note());
    const auto write = [&] {
        const Document document =
            read_document(assembled(sweep, units, shard, folder, output, facts).text, "the sweep");
        say(counts_text(document) + "\nwritten: " + folder.result_file().string());
        return document;
    };
    const AtSignal kept([] {}, "finished cells are kept");
    const DeferSignals deferred;  // what is done is assembled then, too
    try {
        run_units(sweep, units, folder, task, options, facts);
    } catch (const std::exception&) {
        write();  // what is done, before the reason why not all of it is
        throw;
    }
    return exit_code_of(write());
}

}  // namespace

int sweep(const SweepCommand& command, const Options& options)
{
    const Sweep sweep = sweep_described(command);
    const Shard shard = command.shard.empty() ? Shard{} : shard_called(command.shard);
    const std::vector<SweepUnit> all =
        units_of(sweep, command.together == "scene", settings_of(command, options.common));
    const std::vector<unsigned> shards = shards_of(all, shard.of);
    std::vector<SweepUnit> units;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (shards[i] == shard.number)
            units.push_back(all[i]);
    std::string line =
        sweep.name + ": " + sweep.product + ": " + counted(sweep.cells.size(), "cell");
    if (const std::size_t none = sweep.cells.size() - cells_in(all); none > 0)
        line += ", " + std::to_string(none) + " of which cannot be";
    if (!shard.is_all())
        line += "; shard " + command.shard + " has " + std::to_string(cells_in(units));
    say(line);
    if (!command.dry_run)
        return measure(command, options, sweep, all, units, shard);
    print_cells(sweep, all, shards, shard);
    return 0;
}

}  // namespace bvhbench
