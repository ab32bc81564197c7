// SPDX-License-Identifier: MIT
//
// Reading what people write by hand in JSON. All throw BadUsage, in a sentence that names the key; file_text throws Unavailable.
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

/// "a, b, c"
std::string joined(std::span<const std::string_view> words);

/// The entry of a catalog that has the name; `what` it is a catalog of, as "builder".
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
std::string text_in(const Json& json, const char* key);  ///< empty if it is not there
bool truth_at(const Json& json, const char* key);
std::int64_t whole_number(const Json& value, const std::string& what, std::int64_t least,
                          std::int64_t most);

/// The number at `key`, if it is there.
template <class Number>
void read_whole(const Json& json, const char* key, std::int64_t least, std::int64_t most,
                Number& value)
{
    if (json.contains(key))
        value = static_cast<Number>(whole_number(json[key], key, least, most));
}

/// What the JSON library found wrong, for a sentence: without its number for the fault, on one line, printable, and not long.
std::string json_reason(const std::exception& error);

/// Each of the list at `key`, which must not be empty.
void read_list(const Json& json, const char* key, const std::function<void(const Json&)>& add);

/// All of a file. Throws Unavailable, "WHAT 'path' cannot be read: REASON", if it cannot be read or the host has not the
/// memory for it and what is made of it.
std::string file_text(const std::filesystem::path& path, const std::string& what);

}  // namespace bvhbench
