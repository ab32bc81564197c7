// SPDX-License-Identifier: MIT
//
// Reads hand-written JSON. All functions throw BadUsage with a sentence that names the key; file_text throws Unavailable.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/names.h"

namespace bvhbench {

using Json = nlohmann::ordered_json;

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
