// SPDX-License-Identifier: MIT
#include "harness/sweep/described.h"

#include <algorithm>

#include "geometry/error.h"
#include "harness/json_reason.h"
#include "harness/result_file.h"

namespace bvhbench {
namespace {

/// "boxes=f32,u16", into the keys of `set`.
void add_set(const std::string& words, Json& set)
{
    const std::size_t equals = words.find('=');
    if (equals == words.npos || equals == 0)
        throw BadUsage("--set is KEY=V1,V2, not '" + words + "'");
    Json values = Json::array();
    for (std::size_t begin = equals + 1; begin <= words.size();) {
        const std::size_t end = std::min(words.find(',', begin), words.size());
        values.push_back(words.substr(begin, end - begin));
        begin = end + 1;
    }
    set[words.substr(0, equals)] = std::move(values);
}

/// The file with what the command line says in place of its keys.
Json described(const SweepCommand& command)
{
    Json json = Json::object();
    if (!command.file.empty()) {
        try {
            json = Json::parse(file_text(command.file, "the sweep's file"));
        } catch (const Json::exception& error) {
            throw BadUsage(command.file + ": " + json_reason(error));
        }
        if (!json.is_object())
            throw BadUsage(command.file + ": a sweep must be an object");
    }
    const auto replace = [&json](const char* key, const auto& value, bool is_said) {
        if (is_said)
            json[key] = value;
    };
    replace("sweep", command.name, !command.name.empty());
    replace("scenes", command.scenes, !command.scenes.empty());
    replace("sizes", command.sizes, !command.sizes.empty());
    replace("builders", command.builders, !command.builders.empty());
    replace("orders", command.orders, !command.orders.empty());
    replace("colliders", command.colliders, !command.colliders.empty());
    replace("samples", command.samples, command.samples > 0);
    replace("warm_up", command.warm_up, command.warm_up >= 0);
    replace("quality", true, command.quality);
    for (const std::string& words : command.set)
        add_set(words, json["set"]);
    return json;
}

}  // namespace

Sweep sweep_described(const SweepCommand& command)
{
    const Json json = described(command);
    const std::string origin = command.file.empty() ? "" : command.file + ": ";
    try {
        return sweep_of(json);
    } catch (const BadUsage& error) {
        throw BadUsage(origin + error.what());
    } catch (const Json::exception& error) {
        throw BadUsage(origin + json_reason(error));
    }
}

}  // namespace bvhbench
