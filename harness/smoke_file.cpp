// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/error.h"
#include "harness/json_reason.h"
#include "harness/smoke.h"

namespace bvhbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format = "smoke-1";

}  // namespace

std::string smoke_text(const SmokeBaseline& baseline)
{
    std::string text = "{\"format\": \"" + std::string(format) + "\", \"device_kind\": \"" +
                       baseline.device_kind + "\", \"cells\": [";
    const char* comma = "\n";
    for (const SmokeCell& cell : baseline.cells) {
        Json json = {{"cell", cell.name}, {"scene", cell.scene}, {"verdict", cell.verdict}};
        json["counters"] = Json::object();
        for (const auto& [counter, value] : cell.counters) {
            if (value == std::floor(value) && std::fabs(value) < 0x1p53)
                json["counters"][counter] = static_cast<std::int64_t>(value);
            else
                json["counters"][counter] = value;
        }
        json["hashes"] = cell.hashes;
        if (cell.fastest_ns > 0)
            json["fastest_ns"] = static_cast<std::int64_t>(cell.fastest_ns);
        text += comma + json.dump();
        comma = ",\n";
    }
    return text + "\n]}\n";
}

SmokeBaseline read_smoke(const std::string& text, const std::string& origin)
{
    try {
        const Json json = Json::parse(text);
        if (json.at("format") != format)
            throw Unavailable(origin + " has format " + json.at("format").dump() +
                              "; this program reads \"" + format + '"');
        SmokeBaseline baseline{.device_kind = json.at("device_kind"), .cells = {}};
        for (const Json& cell : json.at("cells"))
            baseline.cells.push_back({.name = cell.at("cell"),
                                      .scene = cell.at("scene"),
                                      .verdict = cell.at("verdict"),
                                      .counters = cell.at("counters"),
                                      .hashes = cell.at("hashes"),
                                      .fastest_ns = cell.value("fastest_ns", 0.0)});
        return baseline;
    } catch (const Json::exception& error) {
        throw Unavailable(origin + " is no baseline of smoke: " + json_reason(error));
    }
}

}  // namespace bvhbench
