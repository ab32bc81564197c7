// SPDX-License-Identifier: MIT
#include "harness/json_keys.h"

#include <algorithm>

#include "builders/orders.h"
#include "geometry/error.h"

namespace bvhbench {

std::string joined(std::span<const std::string_view> words)
{
    std::string text;
    for (const std::string_view word : words)
        text += (text.empty() ? "" : ", ") + std::string(word);
    return text;
}

void refuse_unknown_keys(const Json& json, std::initializer_list<std::string_view> known,
                         const std::string& where)
{
    if (!json.is_object())
        throw BadUsage(where + " must be an object");
    for (const auto& [key, value] : json.items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            throw BadUsage("'" + key + "' is no key of " + where +
                           "; there are: " + joined({known.begin(), known.size()}));
}

std::string text_at(const Json& json, const char* key)
{
    const Json& value = json.at(key);
    if (!value.is_string())
        throw BadUsage("'" + std::string(key) + "' must be text");
    return value.get<std::string>();
}

bool truth_at(const Json& json, const char* key)
{
    if (!json.at(key).is_boolean())
        throw BadUsage("'" + std::string(key) + "' is true or false, not " + json[key].dump());
    return json[key].get<bool>();
}

std::int64_t whole_number(const Json& value, const std::string& what, std::int64_t least,
                          std::int64_t most)
{
    if (!value.is_number_integer() || value.get<std::int64_t>() < least ||
        value.get<std::int64_t>() > most)
        throw BadUsage(what + " must be a whole number from " + std::to_string(least) + " to " +
                       std::to_string(most) + ", not " + value.dump());
    return value.get<std::int64_t>();
}

void read_list(const Json& json, const char* key, const std::function<void(const Json&)>& add)
{
    if (!json.at(key).is_array() || json.at(key).empty())
        throw BadUsage("'" + std::string(key) + "' must be a list of at least one");
    for (const Json& item : json.at(key))
        add(item);
}

BuilderChoice builder_choice(const Json& json)
{
    BuilderChoice choice;
    if (json.is_string()) {
        choice.name = json.get<std::string>();
    } else {
        refuse_unknown_keys(
            json, {"name", "order", "grid", "group_size", "items", "leaves", "boxes"}, "a builder");
        choice.name = text_at(json, "name");
        if (json.contains("order"))
            choice.order = text_at(json, "order");
        if (json.contains("grid")) {
            const std::string grid = text_at(json, "grid");
            if (grid != "object" && grid != "scene")
                throw BadUsage("'grid' is object or scene, not '" + grid + "'");
            choice.grid = grid == "scene" ? GridOver::scene : GridOver::object;
        }
        if (json.contains("group_size"))
            choice.group_size =
                static_cast<unsigned>(whole_number(json["group_size"], "group_size", 0, 1 << 16));
        if (json.contains("items"))
            choice.items = static_cast<unsigned>(whole_number(json["items"], "items", 0, 8));
        if (json.contains("boxes"))
            choice.boxes = text_at(json, "boxes");
        choice.sorted_leaves = choice.boxes != "f32";  // if nothing is said of them
        if (json.contains("leaves")) {
            const std::string leaves = text_at(json, "leaves");
            if (leaves != "mesh" && leaves != "sorted")
                throw BadUsage("'leaves' is mesh or sorted, not '" + leaves + "'");
            choice.sorted_leaves = leaves == "sorted";
        }
    }
    find_builder(choice.name);
    find_order(choice.order);
    check_boxes(choice);
    return choice;
}

}  // namespace bvhbench
