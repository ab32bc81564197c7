// SPDX-License-Identifier: MIT
#include "harness/session/tuning_file.h"

#include <re2/re2.h>

#include <cctype>
#include <cstdlib>
#include <iostream>
#include <vector>

#include "baselines/parameters.h"
#include "builders/parameters.h"
#include "collide/parameters.h"
#include "geometry/error.h"
#include "harness/base/json_keys.h"
#include "harness/choice/sampling.h"
#include "harness/record/output.h"

namespace bvhbench {

BVHBENCH_TO_JSON(TunedValue, value, target, scene, ratio, samples, found_at, commit)

namespace {

constexpr auto format = "tuning 1";

/// Returns the parameter of that name; nullptr if there is none.
const Parameter* parameter_called(std::string_view name)
{
    const auto all = tuning_parameters();
    const auto found = std::ranges::find(all, name, &Parameter::name);
    return found == all.end() ? nullptr : *found;
}

TunedValue value_of(const Json& json, const Parameter& parameter)
{
    if (!json.is_object() || !json.contains("value"))
        throw BadUsage("'" + std::string(parameter.name) + "' must be an object with a 'value'");
    refuse_unknown_keys(json,
                        {"value", "target", "scene", "ratio", "samples", "found_at", "commit"},
                        std::string(parameter.name));
    if (!json["value"].is_number_unsigned() || json["value"].get<std::uint64_t>() > parameter.most)
        throw BadUsage(std::string(parameter.name) + " must be from " +
                       std::to_string(parameter.least) + " to " + std::to_string(parameter.most) +
                       ", not " + json["value"].dump());
    TunedValue value;
    value.value = json["value"].get<uint>();
    if (const std::string why = parameter.refusal(value.value); !why.empty())
        throw BadUsage(std::string(parameter.name) + ' ' + why);
    value.target = text_in(json, "target");
    value.scene = text_in(json, "scene");
    value.found_at = text_in(json, "found_at");
    value.commit = text_in(json, "commit");
    if (json.contains("ratio")) {
        if (!json["ratio"].is_number())
            throw BadUsage("'ratio' must be a number, not " + json["ratio"].dump());
        value.ratio = json["ratio"].get<double>();
    }
    read_number(json, "samples", 0, most_samples, value.samples);
    return value;
}

TuningFile file_of(const Json& json, const std::string& origin)
{
    if (!json.is_object() || !json.contains("format") || json["format"] != format)
        throw BadUsage("'format' is not \"" + std::string(format) + '"');
    refuse_unknown_keys(json, {"format", "device", "driver", "values"}, "a tuning file");
    TuningFile file;
    file.device = text_in(json, "device");
    file.driver = text_in(json, "driver");
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
        return file_of(Json::parse(text), origin);
    } catch (const Json::exception& error) {
        throw Unavailable(origin + ": " + json_reason(error));
    } catch (const BadUsage& error) {
        throw Unavailable(origin + ": " + error.what());
    }
}

TuningFile read_tuning(const std::filesystem::path& path)
{
    return parse_tuning(file_text(path, "the tuning file"), path.string());
}

std::string tuning_text(const TuningFile& file)
{
    Json json = {{"format", format}, {"device", file.device}, {"driver", file.driver}};
    json["values"] = Json::object();
    for (const auto& [name, value] : file.values)
        json["values"][name] = value;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

Tuning tuning_of(const TuningFile& file, const Device& device, const std::string& origin)
{
    if (!file.values.empty() && file.device != device.name())
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

NamedTuning tuning_file_for(const Device& device, const std::optional<std::string>& folder)
{
    const std::filesystem::path path = std::filesystem::path(folder.value_or("results/tuning")) /
                                       (device_slug(device.name()) + ".json");
    if (!folder) {
        if (const auto text = embedded_tuning(path.string()))
            return {parse_tuning(*text, path.string()), path.string()};
    } else if (!folder->empty()) {
        if (!std::filesystem::is_directory(*folder))
            throw Unavailable("tuning: there is no folder '" + *folder + "'");
        if (std::filesystem::exists(path))
            return {read_tuning(path), path.string()};
    }
    return {{}, "none"};
}

}  // namespace bvhbench
