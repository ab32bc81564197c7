// SPDX-License-Identifier: MIT
#include "harness/base/json_keys.h"

#include <re2/re2.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "geometry/host_memory.h"

namespace bvhbench {

std::string one_line(const Json& json)
{
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void refuse_unknown_keys(const Json& json, const std::vector<std::string_view>& known,
                         const std::string& where)
{
    if (!json.is_object())
        throw BadUsage(where + " must be an object");
    for (const auto& [key, value] : json.items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            throw BadUsage("'" + key + "' is no key of " + where + there_are(key, known));
}

std::string text_at(const Json& json, const char* key)
{
    const Json& value = json.at(key);
    if (!value.is_string())
        throw BadUsage("'" + std::string(key) + "' must be text");
    return value.get<std::string>();
}

std::string text_in(const Json& json, const char* key, const std::string& usual)
{
    return json.contains(key) ? text_at(json, key) : usual;
}

bool is_true(const Json& json, const char* key)
{
    const Json value = json.value(key, Json(false));
    if (!value.is_boolean())
        throw BadUsage("'" + std::string(key) + "' is true or false, not " + value.dump());
    return value.get<bool>();
}

std::string json_reason(const std::exception& error)
{
    constexpr std::size_t longest = 200;
    std::string text = error.what(), place;
    if (RE2::PartialMatch(text, "parse error at (line \\d+, column \\d+)", &place))
        return "not JSON, at " + place;
    if (text.starts_with("[json.exception."))
        text.erase(0, text.find("] ") + 2);
    if (text.size() > longest)
        text.replace(longest, text.npos, "...");
    for (char& c : text)
        if (c < ' ' || c > '~')
            c = '?';
    return text;
}

void read_list(const Json& json, const char* key, const std::function<void(const Json&)>& add)
{
    if (!json.at(key).is_array() || json.at(key).empty())
        throw BadUsage("'" + std::string(key) + "' must be a list of at least one");
    for (const Json& item : json.at(key))
        add(item);
}

std::string file_text(const std::filesystem::path& path, const std::string& what)
{
    namespace fs = std::filesystem;
    constexpr std::uintmax_t bytes_a_text_byte = 8;  // memory for a parsed document, about
    std::error_code error;
    if (fs::is_directory(path, error))
        throw Unavailable(what + " '" + path.string() + "' cannot be read: it is a folder");
    if (const std::uintmax_t size = fs::file_size(path, error); !error)  // pipes have no size
        require_host_memory("reading '" + path.string() + '\'', bytes_a_text_byte * size);
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::string text;
    if (file.is_open())
        text.assign(std::istreambuf_iterator<char>(file), {});
    if (!file.is_open() || file.bad())
        throw Unavailable(what + " '" + path.string() + "' cannot be read" +
                          (errno != 0 ? std::string(": ") + std::strerror(errno) : ""));
    return text;
}

}  // namespace bvhbench
