// SPDX-License-Identifier: MIT
//
// What can be chosen of a cell besides its scene, builder and collider: one table for options of the command line, keys of
// experiments, keys of result files and `sweep --set`. docs/adding.md tells how an option is added.
#pragma once

#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "harness/base/json_keys.h"
#include "harness/choice/scene_choice.h"

namespace CLI {
class App;
}

namespace bvhbench {

/// All that is chosen of a cell.
struct CellChoice {
    BuilderChoice builder = {};
    ColliderChoice collider = {};
    SceneChoice scene = {};
};

/// One option of a cell.
struct Choice {
    /// Whose it is: an experiment says it in the object of that name. A query's is a key of the pipeline, and result files
    /// have it with the collider's.
    enum class Of { builder, collider, query, scene };

    std::string_view key;  ///< "start_level"; "--start-level" on the command line
    Of of;
    std::string_view values;  ///< what it may be, as a sentence about a wrong value says it
    std::string_view help;
    /// Sets it from a word. Returns false for a word that it may not be; throws BadUsage, with the names that there are, for
    /// an unknown name.
    bool (*set)(CellChoice& choice, const std::string& word);
    /// The value as result files have it: a number, a truth or a word.
    Json (*get)(const CellChoice& choice);
    /// Whether it must be a power of two. What is none is a value that no builder takes: of an experiment, a cell that says so.
    bool is_power_of_two = false;
};

/// Every option, in the order in which they are applied. To add one, add its line.
std::span<const Choice> choices();

/// Sets the option. Throws BadUsage for a value that it may not have: the same sentence wherever the value stood.
void choose(const Choice& option, CellChoice& choice, const std::string& word);

/// Sets what the keys of `json` say of the options of `of`; other keys are left alone. Throws BadUsage.
void read_choices(const Json& json, Choice::Of of, CellChoice& choice);

/// The keys of those options, behind `others`.
std::vector<std::string_view> choice_keys(Choice::Of of,
                                          std::initializer_list<std::string_view> others);

/// All options of `of` and their values.
Json choices_json(const CellChoice& choice, Choice::Of of);

/// Adds the options that `wanted` accepts to a command; they set `choice`, whose values are the defaults.
void add_choices(CLI::App& command, CellChoice& choice,
                 const std::function<bool(const Choice&)>& wanted);

/// Throws BadUsage for a number that must be a power of two and is none.
void check_powers(const CellChoice& choice);

/// Throws BadUsage unless all that is chosen is there and goes together: names, boxes and leaves, narrow phase, swept boxes.
void check_choice(const CellChoice& choice);

}  // namespace bvhbench
