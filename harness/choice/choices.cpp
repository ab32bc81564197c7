// SPDX-License-Identifier: MIT
#include "harness/choice/choices.h"

#include <re2/re2.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "builders/box_format.h"
#include "builders/orders.h"
#include "collide/narrow/narrow_methods.h"
#include "geometry/error.h"
#include "harness/choice/distance_words.h"
#include "harness/choice/filter_words.h"

namespace bvhbench {
namespace {

using Of = Choice::Of;

constexpr unsigned most_levels = 32, most_group = 1 << 16, most_items = 8, most_between = 1000;

bool read_number(const std::string& word, unsigned most, unsigned& value)
{
    unsigned read = 0;
    const bool is_allowed = RE2::FullMatch(word, "(\\d+)", &read) && read <= most;
    value = is_allowed ? read : value;
    return is_allowed;
}

constexpr auto builder = &CellChoice::builder;
constexpr auto collider = &CellChoice::collider;
constexpr auto scene = &CellChoice::scene;

template <auto part, auto member, unsigned most>
bool set_number(CellChoice& choice, const std::string& word)
{
    return read_number(word, most, choice.*part.*member);
}

template <auto part, auto member>
Json value_of(const CellChoice& choice)
{
    return Json(choice.*part.*member);
}

constexpr std::array<std::string_view, 2> grids = {"object", "scene"}, places = {"mesh", "sorted"},
                                          adjacents = {"drop", "keep"}, truths = {"false", "true"};
constexpr std::array<std::string_view, 3> amongs = {"all", "between", "within"},
                                          trees = {"object", "scene", "auto"},
                                          updates = {"auto", "rebuild", "refit"};

/// Sets a boolean or an enumeration whose values are in the order of `words`.
template <auto part, auto member, const auto& words>
bool set_word(CellChoice& choice, const std::string& word)
{
    auto& value = choice.*part.*member;
    const auto found = std::find(words.begin(), words.end(), word);
    if (found != words.end())
        value = static_cast<std::remove_reference_t<decltype(value)>>(found - words.begin());
    return found != words.end();
}

template <auto part, auto member, const auto& words>
Json word_of(const CellChoice& choice)
{
    return Json(words[static_cast<std::size_t>(choice.*part.*member)]);
}

template <auto member>
bool set_distance(CellChoice& choice, const std::string& word)
{
    choice.collider.*member = word;
    return word == "none" || is_distance(word);
}

template <auto member>
bool set_rules(CellChoice& choice, const std::string& word)
{
    unsigned& rules = choice.collider.*member;
    rules = word == "none" ? 0 : rules | skip_rules_called(word);
    return true;
}

template <auto member>
Json rules_of(const CellChoice& choice)
{
    return Json(skip_rules_text(choice.collider.*member));
}

// "boxes" is applied before "leaves": a format other than f32 selects sorted leaves, which an explicit "leaves" overrides.
constexpr Choice table[] = {
    {"order", Of::builder, "a name of `list orders`", "a name of `list orders`",
     [](CellChoice& choice, const std::string& word) {
         find_order(word);
         choice.builder.order = word;
         return true;
     },
     value_of<builder, &BuilderChoice::order>},
    {"grid", Of::builder, "object or scene",
     "object or scene: what codes are measured against, of several objects",
     set_word<builder, &BuilderChoice::grid, grids>, word_of<builder, &BuilderChoice::grid, grids>},
    {"group_size", Of::builder, "a power of two up to 65536, 0 for the builder's choice",
     "lanes in a work-group, a power of two; 0: the builder's choice",
     set_number<builder, &BuilderChoice::group_size, most_group>,
     value_of<builder, &BuilderChoice::group_size>, true},
    {"items", Of::builder, "a power of two up to 8, 0 for the builder's choice",
     "nodes a lane merges in registers, a power of two; 0: the builder's choice",
     set_number<builder, &BuilderChoice::items, most_items>,
     value_of<builder, &BuilderChoice::items>, true},
    {"boxes", Of::builder, "a name of `list formats`",
     "what nodes keep their boxes in: a name of `list formats`",
     [](CellChoice& choice, const std::string& word) {
         find_box_format(word);
         choice.builder.boxes = word;
         choice.builder.sorted_leaves = choice.builder.sorted_leaves || word != "f32";
         return true;
     },
     value_of<builder, &BuilderChoice::boxes>},
    {"leaves", Of::builder, "mesh or sorted",
     "mesh or sorted: where leaf boxes are kept; default: mesh, and sorted for boxes other than "
     "f32",
     set_word<builder, &BuilderChoice::sorted_leaves, places>,
     word_of<builder, &BuilderChoice::sorted_leaves, places>},
    {"pairs_of", Of::query, "all, between or within",
     "pairs of all triangles, between objects or within",
     set_word<collider, &ColliderChoice::among, amongs>,
     word_of<collider, &ColliderChoice::among, amongs>},
    {"adjacent", Of::query, "keep or drop", "keep or drop pairs that share a vertex index",
     set_word<collider, &ColliderChoice::keep_adjacent, adjacents>,
     word_of<collider, &ColliderChoice::keep_adjacent, adjacents>},
    {"narrow", Of::query, "none, or a name of `list narrow`",
     "which pairs intersect: a name of `list narrow`, or none, to stop at their boxes",
     [](CellChoice& choice, const std::string& word) {
         if (word != "none")
             find_narrow_method(word);
         choice.collider.narrow = word;
         return true;
     },
     value_of<collider, &ColliderChoice::narrow>},
    {"first", Of::query, "true or false",
     "end at the first contact: whether any two triangles intersect, exactly, and two that do",
     set_word<collider, &ColliderChoice::first, truths>,
     value_of<collider, &ColliderChoice::first>},
    {"within", Of::query, "none, a distance, or a share as 1% of the diagonal of the scene's box",
     "pairs of triangles at most this far apart, exactly: a distance in the scene's unit, or a "
     "share as 1% of the diagonal of the box around its first frame",
     set_distance<&ColliderChoice::within>, value_of<collider, &ColliderChoice::within>},
    {"separation", Of::query,
     "none, a distance, or a share as 1% of the diagonal of the scene's box",
     "between frames: what comes as near as this minimum separation touches: a distance in the "
     "scene's unit, or a share as 1% of the diagonal of the box around its first frame",
     set_distance<&ColliderChoice::separation>, value_of<collider, &ColliderChoice::separation>},
    {"no_skip", Of::query, "none, all, or a name of `list skips`",
     "a rule of `list skips` that is not used, or all: work is done that need not be",
     set_rules<&ColliderChoice::rules_off>, rules_of<&ColliderChoice::rules_off>},
    {"force_skip", Of::query, "none, all, or a name of `list skips`",
     "a rule of `list skips` that is used even where this device does without it, or all",
     set_rules<&ColliderChoice::rules_forced>, rules_of<&ColliderChoice::rules_forced>},
    {"update", Of::query, "auto, rebuild or refit",
     "trees of later frames: auto, rules and the collider decide; rebuild, in every frame, and "
     "fronts start again; or refit, never rebuild",
     set_word<collider, &ColliderChoice::update, updates>,
     word_of<collider, &ColliderChoice::update, updates>},
    {"trees", Of::query, "auto, object or scene",
     "a tree for each object, one tree over the scene, or auto: one if objects are many and small",
     set_word<collider, &ColliderChoice::trees, trees>,
     word_of<collider, &ColliderChoice::trees, trees>},
    {"jump", Of::collider, "a number of levels up to 32, 0 for the collider's choice",
     "levels a step of a traversal descends; 0: the collider's choice",
     set_number<collider, &ColliderChoice::jump, most_levels>,
     value_of<collider, &ColliderChoice::jump>},
    {"start_level", Of::collider, "a level up to 32, 0 for the collider's choice",
     "the level a traversal starts on; 0: the collider's choice",
     set_number<collider, &ColliderChoice::start_level, most_levels>,
     value_of<collider, &ColliderChoice::start_level>},
    {"group_size", Of::collider, "a power of two up to 65536, 0 for the collider's choice",
     "lanes in a work-group, a power of two; 0: the collider's choice",
     set_number<collider, &ColliderChoice::group_size, most_group>,
     value_of<collider, &ColliderChoice::group_size>, true},
    {"frames", Of::scene, "a:b, from frame a to before b", "a:b, from frame a to before b",
     [](CellChoice& choice, const std::string& word) {
         choice.scene.frames = frame_range(word);
         return true;
     },
     [](const CellChoice& choice) { return Json(frame_range_text(choice.scene.frames)); }},
    {"between", Of::scene, "a number of frames up to 1000",
     "frames put between each two of the scene's, in a straight line",
     set_number<scene, &SceneChoice::between, most_between>,
     value_of<scene, &SceneChoice::between>},
    {"objects", Of::scene, "auto, one, mesh, components or groups",
     "what gets a tree of its own: auto, one, mesh, components, or groups, OBJ's g",
     [](CellChoice& choice, const std::string& word) {
         choice.scene.objects = objects_by_called(word);
         return true;
     },
     [](const CellChoice& choice) { return Json(objects_by_name(choice.scene.objects)); }},
    {"exclude", Of::scene, "none, a pair of objects A,B or @FILE",
     "objects A,B that are not tested with each other, by name or number (A,A: within A), or @FILE "
     "of lines 'exclude A B' and 'group A WORD MASK'",
     [](CellChoice& choice, const std::string& word) {
         if (word == "none")
             choice.scene.exclude.clear();
         return word == "none" || add_exclude_words(choice.scene.exclude, word);
     },
     value_of<scene, &SceneChoice::exclude>},
    {"swept", Of::scene, "true or false",
     "boxes around the way from each frame to the next: vertices against faces, and edges against "
     "edges; --pairs-of between or within has one of the two",
     set_word<scene, &SceneChoice::swept, truths>, value_of<scene, &SceneChoice::swept>},
    {"features", Of::scene, "true or false",
     "with --within: vertices against faces, and edges against edges, in place of triangles; "
     "--pairs-of between or within has one of the two",
     set_word<scene, &SceneChoice::features, truths>, value_of<scene, &SceneChoice::features>},
};

[[noreturn]] void refuse(const Choice& option, const std::string& word)
{
    throw BadUsage("'" + std::string(option.key) + "' takes " + std::string(option.values) +
                   ", not '" + word + "'");
}

}  // namespace

std::span<const Choice> choices() { return table; }

void choose(const Choice& option, CellChoice& choice, const std::string& word)
{
    if (!option.set(choice, word))
        refuse(option, word);
}

void check_powers(const CellChoice& choice)
{
    for (const Choice& option : table)
        if (option.is_power_of_two)
            if (const auto value = option.get(choice).get<unsigned>(); (value & (value - 1)) != 0)
                refuse(option, std::to_string(value));
}

void read_choices(const Json& json, Choice::Of of, CellChoice& choice)
{
    for (const Choice& option : table)
        if (option.of == of && json.contains(option.key)) {
            const Json& value = json[std::string(option.key)];
            choose(option, choice, value.is_string() ? value.get<std::string>() : value.dump());
        }
}

std::vector<std::string_view> choice_keys(Choice::Of of,
                                          std::initializer_list<std::string_view> others)
{
    std::vector<std::string_view> keys(others);
    for (const Choice& option : table)
        if (option.of == of)
            keys.push_back(option.key);
    return keys;
}

Json choices_json(const CellChoice& choice, Choice::Of of)
{
    Json json = Json::object();
    for (const Choice& option : table)
        if (option.of == of)
            json[std::string(option.key)] = option.get(choice);
    return json;
}

void add_choices(CLI::App& command, CellChoice& choice,
                 const std::function<bool(const Choice&)>& wanted)
{
    for (const Choice& option : table) {
        if (!wanted(option))
            continue;
        const Json usual = option.get(choice);
        std::string name = "--" + std::string(option.key);
        std::ranges::replace(name, '_', '-');
        if (usual.is_boolean()) {
            command.add_flag_callback(
                name, [&] { choose(option, choice, "true"); }, std::string(option.help));
            continue;
        }
        CLI::Option* added =
            command
                .add_option_function<std::vector<std::string>>(
                    name,
                    [&](const std::vector<std::string>& words) {
                        for (const std::string& word : words)
                            choose(option, choice, word);
                    },
                    std::string(option.help))
                ->allow_extra_args(false)
                ->type_name(usual.is_number() ? "UINT" : "TEXT")
                ->default_str(usual.is_string() && option.key != "leaves" ? usual.get<std::string>()
                                                                          : "");
        if (!option.key.ends_with("_skip") && option.key != "exclude")  // those may be repeated
            added->expected(1);
    }
}

void check_choice(const CellChoice& choice)
{
    if (choice.builder.name != "none")
        find_builder(choice.builder.name);
    check_boxes(choice.builder);
    if (choice.collider.name.empty())
        return;
    find_collider(choice.collider.name);
    check_narrow(choice.collider.narrow, choice.collider.keep_adjacent);
    if (const std::string& narrow = choice.collider.narrow;
        choice.collider.first && narrow != "none" && !find_narrow_method(narrow).is_exact)
        throw BadUsage(
            "the first contact is exact: beside 'first' 'narrow' is none or exact, not '" + narrow +
            "'");
    if (choice.collider.is_within() && choice.collider.first)
        throw BadUsage("'first' ends at a contact, and 'within' is about all pairs: choose one");
    if (const unsigned both = choice.collider.rules_off & choice.collider.rules_forced; both != 0)
        throw BadUsage("a rule is switched off by 'no_skip' or forced by 'force_skip', not both: " +
                       skip_rules_text(both));
}

}  // namespace bvhbench
