// SPDX-License-Identifier: MIT
#include "harness/sweep/plan.h"

#include <cstring>
#include <set>

#include "builders/orders.h"
#include "geometry/error.h"
#include "harness/experiment.h"
#include "harness/experiment_pipelines.h"
#include "harness/sweep/experiment.h"
#include "harness/sweep/set_keys.h"
#include "harness/sweep/sizes.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

constexpr std::size_t most_cells = 1000000;
constexpr std::string_view hole = "{size}";

std::vector<std::int64_t> sizes_at(const Json& json)
{
    if (!json.contains("sizes"))
        return {};
    const Json& sizes = json["sizes"];
    if (sizes.is_string())
        return sizes_called(sizes.get<std::string>());
    std::string text;
    read_list(json, "sizes", [&](const Json& size) {
        text +=
            (text.empty() ? "" : ",") + (size.is_string() ? size.get<std::string>() : size.dump());
    });
    return sizes_called(text);
}

/// A scene of one cell of a scene's sizes. The keys that frames have are checked by the experiment that it is put into.
SweepCell cell_on(Json scene, std::string name)
{
    SweepCell cell;
    cell.triangles = static_cast<std::int64_t>(triangles_said(name));
    scene["scene"] = std::move(name);
    cell.scene = std::move(scene);
    return cell;
}

/// Each scene once, or once a size where it leaves room for one.
std::vector<SweepCell> scenes_of(const Json& json)
{
    const std::vector<std::int64_t> sizes = sizes_at(json);
    std::vector<SweepCell> scenes;
    bool has_sized = false;
    read_list(json, "scenes", [&](const Json& item) {
        const Json scene = item.is_string() ? Json{{"scene", item}} : item;
        refuse_unknown_keys(scene, {"scene", "frames", "between", "objects", "pairs_of", "swept"},
                            "a scene");
        std::string name = text_at(scene, "scene");
        if (!sizes.empty() && is_sized_generator(name))
            name += ':' + std::string(hole);
        const std::size_t at = name.find(hole);
        if (at == name.npos) {
            scenes.push_back(cell_on(scene, name));
            return;
        }
        if (sizes.empty())
            throw BadUsage("the scene '" + name + "' asks for sizes, and the sweep has none");
        has_sized = true;
        for (const std::int64_t size : sizes)
            scenes.push_back(
                cell_on(scene, std::string(name).replace(at, hole.size(), std::to_string(size))));
    });
    if (!sizes.empty() && !has_sized)
        throw BadUsage(
            "none of the scenes has room for a size: name a generator, as torus, or "
            "write " +
            std::string(hole) + " where it goes, as in refine:bunny:" + std::string(hole));
    return scenes;
}

/// Each builder in each order; one without a name where only colliders are asked for.
std::vector<BuilderChoice> builders_of(const Json& json)
{
    std::vector<BuilderChoice> builders, ordered;
    bool has_own_order = false;
    if (json.contains("builders"))
        read_list(json, "builders", [&](const Json& item) {
            builders.push_back(builder_choice(item));
            has_own_order = has_own_order || (item.is_object() && item.contains("order"));
        });
    else if (json.contains("colliders"))
        builders.push_back({.name = "oibvh-multi"});
    else
        throw BadUsage("a sweep needs builders or colliders");
    if (!json.contains("orders"))
        return builders;
    if (has_own_order)
        throw BadUsage("a builder that names its order leaves none to the sweep's orders");
    for (const BuilderChoice& builder : builders)
        read_list(json, "orders", [&](const Json& order) {
            ordered.push_back(builder);
            ordered.back().order = word_of(order);
            find_order(ordered.back().order);
        });
    return ordered;
}

/// The colliders of a sweep; one without a name where only builders are asked for.
std::vector<ColliderChoice> colliders_of(const Json& json)
{
    std::vector<ColliderChoice> colliders;
    if (!json.contains("colliders"))
        return {{}};
    read_list(json, "colliders",
              [&](const Json& item) { colliders.push_back(collider_choice(item)); });
    return colliders;
}

/// What a combination of things that there are cannot be, by those who would refuse it when it runs.
std::string why_not(const Sweep& sweep, const SweepCell& cell)
{
    try {
        parse_experiment(experiment_of(sweep, {cell}).dump(), "", false);
        return {};
    } catch (const BadUsage& error) {
        const std::string sentence = error.what();
        return sentence.starts_with(": ") ? sentence.substr(2) : sentence;
    }
}

/// Every value of the options with every other, added to `cells`.
void add_options(const SweepCell& cell, std::span<const SetValues> options,
                 std::vector<SweepCell>& cells)
{
    if (options.empty()) {
        cells.push_back(cell);
        if (cells.size() > most_cells)
            throw BadUsage("the sweep has more than " + std::to_string(most_cells) + " cells");
        return;
    }
    for (const std::string& value : options.front().values) {
        SweepCell one = cell;
        options.front().key->apply(one, value);
        add_options(one, options.subspan(1), cells);
    }
}

/// Each once: a builder that a collider does not ask for makes no difference. Scenes that only differ in what result files
/// do not tell would be taken for each other.
std::vector<SweepCell> each_once(std::vector<SweepCell> cells)
{
    std::vector<SweepCell> once;
    std::set<std::string> seen, seen_told;
    for (SweepCell& cell : cells) {
        if (!seen.insert(told(cell) + cell.scene.dump()).second)
            continue;
        if (!seen_told.insert(told(cell)).second)
            throw BadUsage("the scene '" + cell.scene_name() +
                           "' is there twice, and result files do not tell which is which; make "
                           "it two sweeps");
        once.push_back(std::move(cell));
    }
    return once;
}

/// Throws BadUsage for what is said of a scene, before any collider is blamed for it.
void check_scene(const Sweep& sweep, SweepCell scene, bool collides)
{
    scene.builder.name = "oibvh-multi";
    if (collides) {
        scene.collider.name = "leaf";
        scene.collider.keep_adjacent = false;
    } else if (scene.scene.size() > 1) {
        throw BadUsage("the scene '" + scene.scene_name() +
                       "' says what is for colliders, and the sweep has none");
    }
    if (const std::string why = why_not(sweep, scene); !why.empty())
        throw BadUsage("the scene '" + scene.scene_name() + "': " + why);
}

/// What is said besides the product.
Sweep empty_sweep(const Json& json)
{
    Sweep sweep;
    if (json.contains("sweep"))
        sweep.name = text_at(json, "sweep");
    check_experiment_name(sweep.name, "sweep");
    if (json.contains("question"))
        sweep.question = text_at(json, "question");
    if (json.contains("samples"))
        sweep.samples = static_cast<int>(whole_number(json["samples"], "samples", 1, 1000000));
    if (json.contains("warm_up"))
        sweep.warm_up = static_cast<int>(whole_number(json["warm_up"], "warm_up", 0, 1000000));
    if (json.contains("quality"))
        sweep.quality = truth_at(json, "quality");
    return sweep;
}

/// "2 scenes x 3 builders x 2 values of boxes"
std::string product_text(const Json& json, std::size_t scenes, std::span<const SetValues> options)
{
    std::string text = counted(scenes, "scene");
    for (const char* key : {"builders", "orders", "colliders"})
        if (json.contains(key))
            text += " x " + counted(json[key].size(), std::string(key, std::strlen(key) - 1));
    for (const SetValues& one : options)
        text += " x " + counted(one.values.size(), "value") + " of " + std::string(one.key->name);
    return text;
}

/// The whole product, a cell as often as it comes up.
std::vector<SweepCell> product_of(const Json& json, const std::vector<SweepCell>& scenes,
                                  std::span<const SetValues> options)
{
    const std::vector<BuilderChoice> builders = builders_of(json);
    const std::vector<ColliderChoice> colliders = colliders_of(json);
    std::vector<SweepCell> cells;
    for (SweepCell cell : scenes)
        for (const BuilderChoice& builder : builders)
            for (const ColliderChoice& collider : colliders) {
                cell.builder = builder;
                cell.collider = collider;
                add_options(cell, options, cells);
            }
    return cells;
}

/// A cell as results will have it: without a builder that nobody asks for, with what its scene says of pairs.
SweepCell settled(SweepCell cell)
{
    if (cell.collides() && !find_collider(cell.collider.name).needs_tree)
        cell.builder = {.name = "none"};
    if (cell.scene.contains("pairs_of"))
        cell.collider.among = among_called(text_at(cell.scene, "pairs_of"));
    if (cell.scene.value("swept", false))
        cell.collider.keep_adjacent = false;
    return cell;
}

/// Throws BadUsage for a scene that leaves an option nothing to choose.
void check_choices(const SweepCell& scene, std::span<const SetValues> options)
{
    for (const SetValues& one : options) {
        const bool is_pairs = one.key->name == "pairs_of";
        if (is_pairs && scene.scene.contains("pairs_of"))
            throw BadUsage("the scene '" + scene.scene_name() +
                           "' says which pairs it is about, which leaves none to the sweep");
        if (is_pairs && scene.scene.value("swept", false) && one.values.size() > 1)
            throw BadUsage("the scene '" + scene.scene_name() +
                           "' is swept: all its pairs are those between and within, so 'pairs_of' "
                           "may have one value");
    }
}

}  // namespace

Sweep sweep_of(const Json& json)
{
    refuse_unknown_keys(json,
                        {"sweep", "question", "scenes", "sizes", "builders", "orders", "colliders",
                         "set", "samples", "warm_up", "quality"},
                        "a sweep");
    if (!json.contains("scenes"))
        throw BadUsage("a sweep needs scenes");
    Sweep sweep = empty_sweep(json);
    const std::vector<SweepCell> scenes = scenes_of(json);
    const std::vector<SetValues> options = set_values_of(json);
    std::vector<SweepCell> cells = product_of(json, scenes, options);
    for (const SweepCell& scene : scenes) {
        check_scene(sweep, scene, json.contains("colliders"));
        check_choices(scene, options);
    }
    for (SweepCell& cell : cells) {
        cell = settled(std::move(cell));
        cell.why_not = why_not(sweep, cell);
    }
    sweep.cells = each_once(std::move(cells));
    sweep.product = product_text(json, scenes.size(), options);
    return sweep;
}

}  // namespace bvhbench
