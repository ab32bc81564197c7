// SPDX-License-Identifier: MIT
#include "harness/sweep/set_keys.h"

#include <algorithm>
#include <charconv>

#include "builders/box_format.h"
#include "collide/narrow_methods.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

using enum SetKey::Of;

unsigned number(const std::string& value, unsigned most)
{
    unsigned result = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), result);
    if (error != std::errc() || end != value.data() + value.size() || result > most)
        throw BadUsage("'" + value + "' is no whole number from 0 to " + std::to_string(most));
    return result;
}

unsigned power_of_two(const std::string& value, unsigned most)
{
    const unsigned result = number(value, most);
    if ((result & (result - 1)) != 0)
        throw BadUsage("'" + value + "' is no power of two");
    return result;
}

/// Whether it is the second of two words.
bool is_second(const std::string& value, std::string_view first, std::string_view second)
{
    if (value != first && value != second)
        throw BadUsage("'" + value + "' is neither " + std::string(first) + " nor " +
                       std::string(second));
    return value == second;
}

constexpr unsigned most_levels = 32, most_group = 1 << 16;

// Boxes before leaves: boxes of another format want sorted leaves, unless something is said of leaves.
constexpr SetKey keys[] = {
    {"grid", builder, "object or scene",
     [](SweepCell& cell, const std::string& value) {
         cell.builder.grid =
             is_second(value, "object", "scene") ? GridOver::scene : GridOver::object;
     }},
    {"builder.group_size", builder, "powers of two, 0 for the builder's choice",
     [](SweepCell& cell, const std::string& value) {
         cell.builder.group_size = power_of_two(value, most_group);
     }},
    {"items", builder, "powers of two up to 8, 0 for the builder's choice",
     [](SweepCell& cell, const std::string& value) {
         cell.builder.items = power_of_two(value, 8);
     }},
    {"boxes", builder, "names of `list formats`",
     [](SweepCell& cell, const std::string& value) {
         find_box_format(value);
         cell.builder.boxes = value;
         cell.builder.sorted_leaves = cell.builder.sorted_leaves || value != "f32";
     }},
    {"leaves", builder, "mesh or sorted",
     [](SweepCell& cell, const std::string& value) {
         cell.builder.sorted_leaves = is_second(value, "mesh", "sorted");
     }},
    {"pairs_of", collider, "all, between or within",
     [](SweepCell& cell, const std::string& value) { cell.collider.among = among_called(value); }},
    {"adjacent", collider, "keep or drop",
     [](SweepCell& cell, const std::string& value) {
         cell.collider.keep_adjacent = !is_second(value, "keep", "drop");
     }},
    {"narrow", collider, "none, or names of `list narrow`",
     [](SweepCell& cell, const std::string& value) {
         if (value != "none")
             find_narrow_method(value);
         cell.collider.narrow = value;
     }},
    {"no_skip", collider, "none, all, or names of `list skips`",
     [](SweepCell& cell, const std::string& value) {
         cell.collider.rules_off = value == "none" ? 0 : skip_rules_called({&value, 1});
     }},
    {"jump", collider, "numbers of levels, 0 for the collider's choice",
     [](SweepCell& cell, const std::string& value) {
         cell.collider.jump = number(value, most_levels);
     }},
    {"start_level", collider, "levels, 0 for the collider's choice",
     [](SweepCell& cell, const std::string& value) {
         cell.collider.start_level = number(value, most_levels);
     }},
    {"collider.group_size", collider, "powers of two, 0 for the collider's choice",
     [](SweepCell& cell, const std::string& value) {
         cell.collider.group_size = power_of_two(value, most_group);
     }},
    {"frames", scene, "a:b, from frame a to before b",
     [](SweepCell& cell, const std::string& value) {
         frame_range(value);
         cell.scene["frames"] = value;
     },
     false},
    {"between", scene, "how many frames are put between each two",
     [](SweepCell& cell, const std::string& value) { cell.scene["between"] = number(value, 1000); },
     false},
    {"objects", scene, "auto, one, mesh or components",
     [](SweepCell& cell, const std::string& value) {
         objects_by_called(value);
         cell.scene["objects"] = value;
     },
     false},
    {"swept", scene, "true or false",
     [](SweepCell& cell, const std::string& value) {
         cell.scene["swept"] = is_second(value, "false", "true");
     },
     false},
};

}  // namespace

std::span<const SetKey> set_keys() { return keys; }

const SetKey& find_set_key(std::string_view name)
{
    std::string known;
    for (const SetKey& key : keys) {
        if (key.name == name)
            return key;
        known += (known.empty() ? "" : ", ") + std::string(key.name);
    }
    throw BadUsage("a sweep sets no '" + std::string(name) + "'; there are: " + known);
}

std::string word_of(const Json& value)
{
    return value.is_string() ? value.get<std::string>() : value.dump();
}

std::vector<SetValues> set_values_of(const Json& json)
{
    std::vector<SetValues> all;
    if (!json.contains("set"))
        return all;
    if (!json["set"].is_object())
        throw BadUsage("'set' must be an object of options, each with a list of values");
    for (const auto& item : json["set"].items()) {
        const std::string& name = item.key();
        SetValues one{&find_set_key(name), {}};
        if (one.key->of != SetKey::Of::builder && !json.contains("colliders"))
            throw BadUsage("'" + name + "' is for colliders, and the sweep has none");
        read_list(json["set"], name.c_str(), [&](const Json& value) {
            SweepCell scratch;
            try {
                one.key->apply(scratch, word_of(value));
            } catch (const BadUsage& error) {
                throw BadUsage("'" + name + "' takes " + std::string(one.key->values) + ": " +
                               error.what());
            }
            one.values.push_back(word_of(value));
        });
        if (!one.key->is_told && one.values.size() > 1)
            throw BadUsage("'" + name +
                           "' may have one value: result files do not tell cells of "
                           "several apart; make it several sweeps");
        all.push_back(std::move(one));
    }
    std::sort(all.begin(), all.end(),
              [](const SetValues& a, const SetValues& b) { return a.key < b.key; });
    return all;
}

}  // namespace bvhbench
