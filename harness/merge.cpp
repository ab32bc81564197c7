// SPDX-License-Identifier: MIT
//
// Cells go on as the JSON that they are: what this program would not write, be it older or newer, stays.
#include "harness/merge.h"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "geometry/error.h"
#include "harness/json_keys.h"
#include "harness/record.h"

namespace bvhbench {
namespace {

/// The format in which `merged_from` came.
constexpr int first_minor = 8;

struct Part {
    const std::string& origin;
    Json json;
    std::map<std::string, Json> runs;  ///< by id
};

/// What a merged file keeps of a run.
Json source_of(const Json& run)
{
    Json source = {{"id", run.at("id")}, {"started_at", run.at("started_at")}};
    const auto keep = [&source](const Json& from, const char* key, const char* as) {
        if (from.contains(key))
            source[as] = from[key];
    };
    keep(run, "finished_at", "finished_at");
    source["command"] = run.at("command");
    keep(run.at("program"), "commit", "commit");
    keep(run.at("program"), "dirty", "dirty");
    keep(run.at("host"), "name", "host");
    keep(run.at("device"), "name", "device");
    keep(run.at("device"), "driver", "driver");
    keep(run, "copy_rate_bytes_per_s", "copy_rate_bytes_per_s");
    keep(run, "launch_cost_ns", "launch_cost_ns");
    return source;
}

Part part_of(const MergePart& part)
{
    read_document(part.text, part.origin);  // refuses what is no result file
    Part result{part.origin, Json::parse(part.text), {}};
    if (result.json.contains("merged_from"))
        for (const Json& source : result.json["merged_from"])
            result.runs[text_at(source, "id")] = source;
    else
        result.runs[text_at(result.json["run"], "id")] = source_of(result.json["run"]);
    return result;
}

std::string device_of(const Json& source)
{
    return source.value("device", "") + ", driver " + source.value("driver", "");
}

std::string commit_of(const Json& source)
{
    return source.value("commit", "").substr(0, 10) +
           (source.value("dirty", false) ? " with changes" : "");
}

/// All that parts have in common, or the sentence about the first that has not.
void require_alike(const std::vector<Part>& parts, const MergeAllows& allows)
{
    const Part& first = parts.front();
    const Json& like = first.runs.begin()->second;
    for (const Part& part : parts) {
        const std::string one = text_at(first.json, "format"), other = text_at(part.json, "format");
        if (one != other)
            throw BadUsage(first.origin + " has format " + one + " and " + part.origin + ' ' +
                           other + ": merge takes files of one format");
        for (const auto& [id, source] : part.runs) {
            if (!allows.other_devices && device_of(source) != device_of(like))
                throw BadUsage(first.origin + " is of " + device_of(like) + ", and " + part.origin +
                               " of " + device_of(source) +
                               ": --other-devices merges them all the same");
            if (!allows.other_commits && commit_of(source) != commit_of(like))
                throw BadUsage(first.origin + " is of commit " + commit_of(like) + ", and " +
                               part.origin + " of " + commit_of(source) +
                               ": --other-commits merges them all the same");
        }
    }
}

/// What a cell is about, whatever came of it: what identity_text of harness/cell_identity.h tells, of the JSON itself, so that
/// options which this program does not know tell cells apart as well.
Json about(const Json& cell)
{
    Json key;
    for (const char* name : {"experiment", "builder", "collider", "accuracy", "family", "system"})
        if (cell.contains(name))
            key[name] = cell[name];
    key["operation"] = cell.value("operation", "build");
    const Json& scene = cell.at("scene");
    key["scene"] =
        scene.is_object()
            ? Json{scene.at("name"), scene.value("frame", 0), scene.value("stand_in_for", ""),
                   scene.value("objects_by", ""), scene.value("between", 0)}
            : scene;
    if (cell.contains("sampling"))
        key["caches"] = cell["sampling"].value("caches", "hot");
    if (cell.contains("swept"))
        key["swept"] = {cell["swept"].at("pairs"), cell["swept"].at("to_frame")};
    return key;
}

std::string called(const Json& cell)
{
    const Json& scene = cell.at("scene");
    std::string text = scene.is_object() ? text_at(scene, "name") : scene.get<std::string>();
    for (const char* name : {"builder", "collider"})
        if (cell.contains(name))
            text += ", " + text_at(cell[name], "name");
    return text + (cell.contains("system") ? ", " + text_at(cell, "system") : "");
}

/// Cells of one kind from all parts, each once.
class Collected {
public:
    explicit Collected(Merged& merged) : merged_(merged) {}

    void add(const Part& part, const char* list)
    {
        if (!part.json.contains(list))
            return;
        std::map<std::string, int>
            times;  // a file may have a cell twice: the second is another file's second
        for (Json cell : part.json[list]) {
            if (!cell.contains("run"))
                cell["run"] = part.json["run"]["id"];
            const auto source = part.runs.find(text_at(cell, "run"));
            std::string key = about(cell).dump();
            if (source != part.runs.end())
                key += device_of(source->second);
            key += '#' + std::to_string(times[key]++);
            add(part, key, cell);
        }
    }

    const std::vector<std::string>& texts() const { return texts_; }
    bool is_of(const std::string& run) const { return used_.contains(run); }

private:
    struct Seen {
        const std::string& origin;
        std::size_t place;
    };

    void add(const Part& part, const std::string& key, const Json& cell)
    {
        // As the program's own files, which hold UTF-8 only whatever is in names.
        std::string text = cell.dump(-1, ' ', false, Json::error_handler_t::replace);
        const auto [found, is_new] = seen_.try_emplace(key, Seen{part.origin, texts_.size()});
        if (is_new) {
            merged_.differs =
                merged_.differs || cell.value("/check/verdict"_json_pointer, "") == "differs";
            texts_.push_back(std::move(text));
            used_.insert(text_at(cell, "run"));
            return;
        }
        if (texts_[found->second.place] != text)
            throw BadUsage(found->second.origin + " and " + part.origin + " both have " +
                           called(cell) +
                           ", and not the same of it: a merged file has each cell once, so leave "
                           "one of them out");
        ++merged_.repeated;
    }

    Merged& merged_;
    std::vector<std::string> texts_;
    std::map<std::string, Seen> seen_;
    std::set<std::string> used_;  ///< runs
};

std::string format_of(const Json& json)
{
    const std::string format = text_at(json, "format");
    return "1." + std::to_string(std::max(first_minor, std::stoi(format.substr(2))));
}

}  // namespace

Merged merge(std::span<const MergePart> files, const MergeAllows& allows)
{
    std::vector<Part> parts;
    for (const MergePart& file : files)
        parts.push_back(part_of(file));
    require_alike(parts, allows);
    Merged merged;
    Collected cells(merged), stress(merged);
    for (const Part& part : parts) {
        cells.add(part, "cells");
        stress.add(part, "stress");
    }
    std::set<std::string> told;
    std::vector<std::string> sources;
    for (const Part& part : parts)
        for (const auto& [id, source] : part.runs)
            if ((cells.is_of(id) || stress.is_of(id)) && told.insert(id).second)
                sources.push_back(source.dump(-1, ' ', false, Json::error_handler_t::replace));
    merged.cells = cells.texts().size() + stress.texts().size();
    merged.runs = sources.size();
    const std::string run =
        parts.front().json["run"].dump(-1, ' ', false, Json::error_handler_t::replace);
    merged.text =
        document_text(run, cells.texts(), stress.texts(), sources, format_of(parts.front().json));
    return merged;
}

}  // namespace bvhbench
