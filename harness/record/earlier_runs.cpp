// SPDX-License-Identifier: MIT
#include "harness/record/earlier_runs.h"

#include <algorithm>
#include <sstream>

#include "geometry/error.h"

namespace bvhbench {
namespace {

MeasuredPart& part_called(EarlierRuns& earlier, const std::string& key)
{
    const auto [place, is_new] = earlier.parts.try_emplace(key);
    if (is_new)
        earlier.order.push_back(key);
    return place->second;
}

void add(EarlierRuns& earlier, const Json& line)
{
    if (line.contains("run")) {
        earlier.runs.push_back(line["run"]);
        earlier.last_run = line["run"];
        return;
    }
    MeasuredPart& part = part_called(earlier, line.at("part"));
    if (line.contains("keeps")) {
        part.has_ended = false;
        part.cells.resize(std::min(line["keeps"].get<std::size_t>(), part.cells.size()));
    }
    if (line.contains("ended")) {
        part.has_ended = true;
        part.seconds = line["ended"].get<double>();
    }
    if (line.contains("cell")) {
        part.cells.push_back(line["cell"]);
        part.cells.back()["run"] = earlier.last_id();
    }
}

std::string device_of(const Json& source)
{
    return source.value("device", "") + ", driver " + source.value("driver", "");
}

std::string program_of(const Json& source)
{
    return "commit " + source.value("commit", "").substr(0, 10) +
           (source.value("dirty", false) ? " with changes" : "");
}

}  // namespace

std::string EarlierRuns::last_id() const
{
    return last_run.is_object() ? last_run.value("id", "") : "";
}

void EarlierRuns::check(const std::filesystem::path& path, const std::set<std::string>& keys,
                        const Json& run, bool other_commits) const
{
    const auto foreign =
        std::ranges::count_if(order, [&](const std::string& key) { return !keys.contains(key); });
    const std::string holds = path.string() + " has ";
    const char* const instead = "; choose another --out, or --force begins anew";
    if (foreign > 0)
        throw BadUsage(holds + std::to_string(foreign) + " of " + std::to_string(order.size()) +
                       " parts that are none of this plan, or were measured with other options" +
                       instead);
    const Json own = source_of(run);
    for (const Json& each : runs) {
        const Json source = source_of(each);
        if (device_of(source) != device_of(own))
            throw BadUsage(holds + "cells of " + device_of(source) + ", and this is " +
                           device_of(own) + instead);
        if (program_of(source) != program_of(own) && !other_commits)
            throw BadUsage(holds + "cells by " + program_of(source) + ", and this program is of " +
                           program_of(own) + ": --continue-other-commit keeps them and goes on" +
                           instead);
    }
}

EarlierRuns runs_in_result(const std::filesystem::path& path)
{
    const Json json = Json::parse(file_text(path, "the result file"), nullptr, false);
    if (!json.is_object() || !json.contains("run") || !json.contains("cells"))
        throw BadUsage(path.string() + " is no result file");
    EarlierRuns earlier;
    earlier.last_run = json["run"];
    earlier.runs = json.value("merged_from", std::vector<Json>{json["run"]});
    for (const Json& cell : json["cells"]) {
        const bool has_part = cell.contains("part");
        if (!has_part && cell.value("status", "") == "skipped")
            continue;  // an impossible cell of the plan, which is written again
        if (!has_part)
            throw BadUsage(path.string() +
                           " is a result, and its cells do not say of which part of a plan they "
                           "are; --force replaces it, or choose another file");
        MeasuredPart& part = part_called(earlier, cell["part"]);
        part.has_ended = true;
        part.cells.push_back(cell);
        if (!cell.contains("run"))
            part.cells.back()["run"] = earlier.last_id();
    }
    for (const Json& key : json["run"].value("unfinished_parts", Json::array()))
        part_called(earlier, key).has_ended = false;
    return earlier;
}

bool add_journal(const std::filesystem::path& path, EarlierRuns& earlier)
{
    EarlierRuns all = earlier;
    std::istringstream text(file_text(path, "the journal"));
    bool has_run = false;
    for (std::string line; std::getline(text, line) && !text.eof();) {
        const Json json = Json::parse(line, nullptr, false);
        has_run = has_run || json.contains("run");
        if (!has_run || !(json.contains("run") || json.contains("part")))
            throw Unavailable(path.string() + " is no journal of a run; remove it to measure anew");
        add(all, json);
    }
    if (all.last_id() == earlier.last_id())
        return false;
    earlier = std::move(all);
    return true;
}

Json source_of(const Json& run)
{
    if (!run.contains("program"))
        return run;
    Json source;
    const auto keep = [&](const Json& facts, const char* key, const char* name) {
        if (facts.contains(key))
            source[name] = facts[key];
    };
    for (const char* key : {"id", "started_at", "finished_at", "command"})
        keep(run, key, key);
    keep(run["program"], "commit", "commit");
    keep(run["program"], "dirty", "dirty");
    keep(run["host"], "name", "host");
    keep(run["device"], "name", "device");
    keep(run["device"], "driver", "driver");
    for (const char* key : {"copy_rate_bytes_per_s", "launch_cost_ns", "conditions"})
        keep(run, key, key);
    return source;
}

}  // namespace bvhbench
