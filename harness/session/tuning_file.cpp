// SPDX-License-Identifier: MIT
#include "harness/session/tuning_file.h"

#include <re2/re2.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <vector>

#include "baselines/parameters.h"
#include "builders/parameters.h"
#include "collide/parameters.h"
#include "geometry/error.h"
#include "harness/base/json_keys.h"
#include "harness/choice/sampling.h"

namespace bvhbench {

BVHBENCH_TO_JSON(DeviceKind, family, units, group_memory)
BVHBENCH_TO_JSON(TunedValue, value, target, scene, ratio, samples, found_at, commit)

namespace {

constexpr auto format = "tuning 1";
constexpr double most_ratio = 1e9;
constexpr std::uint64_t most_units = 1 << 20, most_group_memory = std::uint64_t{1} << 32;
const std::initializer_list<const char*> embedded_files = {BVHBENCH_TUNINGS};

/// Returns the parameter of that name; nullptr if there is none.
const Parameter* parameter_called(std::string_view name)
{
    const auto all = tuning_parameters();
    const auto found = std::ranges::find(all, name, &Parameter::name);
    return found == all.end() ? nullptr : *found;
}

TunedValue value_of(const Json& json, const Parameter& parameter)
{
    const std::string name(parameter.name);
    if (!json.is_object() || !json.contains("value"))
        throw BadUsage("'" + name + "' must be an object with a 'value'");
    refuse_unknown_keys(
        json, {"value", "target", "scene", "ratio", "samples", "found_at", "commit"}, name);
    TunedValue value;
    value.value = number_of<uint>(json["value"], name, parameter.least, parameter.most);
    if (const std::string why = parameter.refusal(value.value); !why.empty())
        throw BadUsage(name + ' ' + why);
    value.target = text_in(json, "target");
    value.scene = text_in(json, "scene");
    value.found_at = text_in(json, "found_at");
    value.commit = text_in(json, "commit");
    read_number(json, "ratio", 0, most_ratio, value.ratio);
    read_number(json, "samples", 0, most_samples, value.samples);
    return value;
}

TuningFile file_of(const Json& json, const std::string& origin)
{
    if (!json.is_object() || !json.contains("format") || json["format"] != format)
        throw BadUsage("'format' is not \"" + std::string(format) + '"');
    refuse_unknown_keys(json, {"format", "device", "driver", "kind", "values"}, "a tuning file");
    TuningFile file;
    file.device = text_in(json, "device");
    file.driver = text_in(json, "driver");
    if (json.contains("kind")) {
        const Json& kind = json["kind"];
        refuse_unknown_keys(kind, {"family", "units", "group_memory"}, "'kind'");
        file.kind.family = text_at(kind, "family");
        read_number(kind, "units", 1, most_units, file.kind.units);
        read_number(kind, "group_memory", 1, most_group_memory, file.kind.group_memory);
    }
    if (!json.contains("values") || !json["values"].is_object())
        throw BadUsage("'values' must be an object of parameters");
    for (const auto& [name, value] : json["values"].items())
        if (const Parameter* parameter = parameter_called(name))
            file.values[name] = value_of(value, *parameter);
        else
            std::cerr
                << "bvhbench: " << origin << ": no parameter is called '" << name
                << "', and its value is not used; `bvhbench list tuning` shows what there is\n";
    return file;
}

}  // namespace

std::span<const Parameter* const> tuning_parameters()
{
    static const std::vector<const Parameter*> all = [] {
        std::vector<const Parameter*> list;
        list.insert(list.end(), std::begin(builder_parameters), std::end(builder_parameters));
        list.insert(list.end(), std::begin(baseline_parameters), std::end(baseline_parameters));
        list.insert(list.end(), std::begin(collider_parameters), std::end(collider_parameters));
        return list;
    }();
    return all;
}

std::string device_slug(std::string_view device)
{
    std::string slug(device);
    for (char& c : slug)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    RE2::GlobalReplace(&slug, RE2("[^a-z0-9]+", RE2::Latin1), "-");
    RE2::GlobalReplace(&slug, "^-|-$", "");
    return slug.empty() ? "device" : slug;
}

TuningFile parse_tuning(std::string_view text, const std::string& origin)
{
    try {
        return read_json(text, origin, [&](const Json& json) { return file_of(json, origin); });
    } catch (const BadUsage& error) {
        throw Unavailable(error.what());
    }
}

TuningFile read_tuning(const std::filesystem::path& path)
{
    return parse_tuning(file_text(path, "the tuning file"), path.string());
}

std::string tuning_text(const TuningFile& file)
{
    Json json = {{"format", format}, {"device", file.device}, {"driver", file.driver}};
    if (!file.kind.family.empty())
        json["kind"] = file.kind;
    json["values"] = file.values;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

Tuning tuning_of(const TuningFile& file, const Device& device, const std::string& origin)
{
    const bool is_near = !file.kind.family.empty() && file.kind.family == kind_of(device).family;
    if (!file.values.empty() && file.device != device.name() && !is_near)
        throw Unavailable(origin + ": its values are of '" + file.device +
                          "', and the device is '" + device.name() + "'");
    Tuning tuning(origin);
    for (const auto& [name, found] : file.values) {
        const Parameter* parameter = parameter_called(name);
        if (parameter->is_group_size)
            device.require_group(origin + ": " + name, found.value, 0);
        tuning.set(*parameter, found.value);
    }
    return tuning;
}

std::optional<std::string> tuning_folder(const std::optional<std::string>& option)
{
    const char* variable = std::getenv("BVHBENCH_TUNING");
    return option || variable == nullptr ? option : std::optional<std::string>(variable);
}

DeviceKind kind_of(const Device& device)
{
    DeviceKind kind{{},
                    device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>(),
                    device.cl.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>()};
    const auto word = [&](cl_device_info what) {  // of cl_nv_device_attribute_query
        cl_uint value = 0;
        return clGetDeviceInfo(device.cl(), what, sizeof value, &value, nullptr) == CL_SUCCESS
                   ? std::to_string(value)
                   : std::string();
    };
    if (const std::string major = word(0x4000), minor = word(0x4001); !major.empty())
        kind.family = "sm_" + major + minor;
    return kind;
}

bool is_nearer(const DeviceKind& one, const DeviceKind& other, const DeviceKind& own)
{
    const auto distance = [&](const DeviceKind& kind) {
        const bool suits = !kind.family.empty() && kind.family == own.family &&
                           kind.group_memory <= own.group_memory;
        return !suits ? std::numeric_limits<double>::infinity()
                      : std::abs(std::log(static_cast<double>(kind.units) /
                                          static_cast<double>(own.units)));
    };
    return distance(one) < distance(other);
}

NamedTuning tuning_file_for(const Device& device, const std::optional<std::string>& folder)
{
    if (folder && !folder->empty() && !std::filesystem::is_directory(*folder))
        throw Unavailable("tuning: there is no folder '" + *folder + "'");
    std::vector<std::filesystem::path> paths;
    if (!folder)
        paths.assign(embedded_files.begin(), embedded_files.end());
    else if (!folder->empty())
        for (const auto& entry : std::filesystem::directory_iterator(*folder))
            if (entry.path().extension() == ".json")
                paths.push_back(entry.path());
    const auto file_at = [&](const std::filesystem::path& path) {
        return folder ? read_tuning(path)
                      : parse_tuning(embedded_tuning(path.string()).value(), path.string());
    };
    const std::string own = device_slug(device.name());
    for (const auto& path : paths)
        if (path.stem() == own)
            return {file_at(path), path.string()};
    std::ranges::sort(paths);
    const DeviceKind kind = kind_of(device);
    NamedTuning found{{}, "none"};
    for (const auto& path : paths) {
        if (kind.family.empty())
            break;
        TuningFile file = file_at(path);
        if (is_nearer(file.kind, found.file.kind, kind))
            found = {std::move(file), path.string()};
    }
    if (!found.file.device.empty())
        found.origin += ", of " + found.file.device + ", the nearest";
    return found;
}

}  // namespace bvhbench
