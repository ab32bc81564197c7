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
#include <type_traits>
#include <vector>

#include "geometry/names.h"

namespace bvhbench {

using Json = nlohmann::ordered_json;

/// For lists of numbers: floats are written as the shortest text that reads back as the same bits.
using FloatJson = nlohmann::basic_json<nlohmann::ordered_map, std::vector, std::string, bool,
                                       std::int64_t, std::uint64_t, float>;

/// Defines to_json with one key for each member, named as the member.
#define BVHBENCH_TO_JSON(Type, ...)                                              \
    static void to_json(Json& nlohmann_json_j, const Type& nlohmann_json_t)      \
    {                                                                            \
        NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_TO, __VA_ARGS__)) \
    }

/// Returns the JSON on one line. Replaces invalid UTF-8, which file names and logs may contain and JSON files must not.
std::string one_line(const Json& json);

void refuse_unknown_keys(const Json& json, const std::vector<std::string_view>& known,
                         const std::string& where);
std::string text_at(const Json& json, const char* key);
/// `usual` if the key is missing.
std::string text_in(const Json& json, const char* key, const std::string& usual = {});
bool is_true(const Json& json, const char* key);  ///< false if the key is missing

/// Returns the number. An integral `Number` must be a whole one. `what` names it in the sentence.
template <class Number>
Number number_of(const Json& value, const std::string& what, Number least, Number most)
{
    const bool is_whole = std::is_integral_v<Number>;
    if (!(is_whole ? value.is_number_integer() : value.is_number()) ||
        !(value >= least && value <= most))
        throw BadUsage(what + " must be a " + (is_whole ? "whole number" : "number") + " from " +
                       Json(least).dump() + " to " + Json(most).dump() + ", not " + value.dump());
    return value.get<Number>();
}

/// Reads the number at `key` into `value` if the key is present.
template <class Number>
void read_number(const Json& json, const char* key, std::type_identity_t<Number> least,
                 std::type_identity_t<Number> most, Number& value)
{
    if (json.contains(key))
        value = number_of<Number>(json[key], key, least, most);
}

/// Sets the key, unless the value is empty, 0 or false.
template <class Value>
void put_if(Json& json, const char* key, const Value& value)
{
    if (value != Value{})
        json[key] = value;
}

/// Returns where a text stops being JSON. Of other errors of the JSON library, returns the message: one printable line, cut after
/// 200 characters.
std::string json_reason(const std::exception& error);

/// Returns what `read` makes of a JSON text. Throws BadUsage, with `origin` in front unless it is empty, if the text is not JSON or `read`
/// throws one.
template <class Read>
auto read_json(std::string_view text, const std::string& origin, const Read& read)
{
    const std::string where = origin.empty() ? "" : origin + ": ";
    try {
        return read(Json::parse(text));
    } catch (const Json::exception& error) {
        throw BadUsage(where + json_reason(error));
    } catch (const BadUsage& error) {
        throw BadUsage(where + error.what());
    }
}

/// Calls `add` with each item of the list at `key`. Throws BadUsage unless that is a list of at least one item.
void read_list(const Json& json, const char* key, const std::function<void(const Json&)>& add);

/// Returns the contents of a file. Throws Unavailable, "WHAT 'path' cannot be read: REASON", if the file cannot be read or if
/// host memory does not suffice for the text and the document parsed from it.
std::string file_text(const std::filesystem::path& path, const std::string& what);

}  // namespace bvhbench
