// SPDX-License-Identifier: MIT
//
// Reads hand-written JSON. All functions throw BadUsage with a sentence that names the key; file_text throws Unavailable.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/error.h"

namespace bvhbench {

using Json = nlohmann::ordered_json;

/// Defines to_json with one key for each member, named as the member.
#define BVHBENCH_TO_JSON(Type, ...)                                              \
    static void to_json(Json& nlohmann_json_j, const Type& nlohmann_json_t)      \
    {                                                                            \
        NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_TO, __VA_ARGS__)) \
    }

/// Returns the JSON on one line. Replaces invalid UTF-8, which file names and logs may contain and JSON files must not.
std::string one_line(const Json& json);

/// Returns the words separated by commas: "a, b, c".
std::string joined(std::span<const std::string_view> words);

/// Returns the entry of `catalog` called `name`. Throws BadUsage with the known names. `what` names the kind, as "builder".
template <class Entry>
const Entry& find_called(std::span<const Entry> catalog, std::string_view name,
                         const std::string& what)
{
    std::vector<std::string_view> known;
    for (const Entry& entry : catalog) {
        if (entry.name == name)
            return entry;
        known.push_back(entry.name);
    }
    throw BadUsage("no " + what + " is called '" + std::string(name) +
                   "'; there are: " + joined(known));
}

void refuse_unknown_keys(const Json& json, const std::vector<std::string_view>& known,
                         const std::string& where);
std::string text_at(const Json& json, const char* key);
std::string text_in(const Json& json, const char* key);  ///< empty if the key is missing
bool truth_at(const Json& json, const char* key);
std::int64_t whole_number(const Json& value, const std::string& what, std::int64_t least,
                          std::int64_t most);

/// Reads the number at `key` into `value` if the key is present.
template <class Number>
void read_whole(const Json& json, const char* key, std::int64_t least, std::int64_t most,
                Number& value)
{
    if (json.contains(key))
        value = static_cast<Number>(whole_number(json[key], key, least, most));
}

/// Returns the JSON library's message without its error number: one printable line, cut after 200 characters.
std::string json_reason(const std::exception& error);

/// Calls `add` with each item of the list at `key`. Throws BadUsage unless that is a list of at least one item.
void read_list(const Json& json, const char* key, const std::function<void(const Json&)>& add);

/// Returns the contents of a file. Throws Unavailable, "WHAT 'path' cannot be read: REASON", if the file cannot be read or if
/// host memory does not suffice for the text and the document parsed from it.
std::string file_text(const std::filesystem::path& path, const std::string& what);

}  // namespace bvhbench
