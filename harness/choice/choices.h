// SPDX-License-Identifier: MIT
//
// Options of a cell besides the names of its scene, builder and collider. One table serves the command line, experiment files,
// result files and `sweep --set`. docs/adding.md explains how to add an option.
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

/// Everything that is chosen for a cell.
struct CellChoice {
    BuilderChoice builder = {};
    ColliderChoice collider = {};
    SceneChoice scene = {};

    bool operator==(const CellChoice&) const = default;
};

/// One option of a cell.
struct Choice {
    /// The part of a cell that the option belongs to, which is the JSON object that has its key. Options of a query are keys of
    /// the pipeline in experiments, and are stored with the collider's in result files.
    enum class Of { builder, collider, query, scene };

    std::string_view key;  ///< "start_level"; "--start-level" on the command line
    Of of;
    std::string_view values;  ///< allowed values, for error messages
    std::string_view help;
    /// Sets the option from a word. Returns false if the word is not allowed. Throws BadUsage with the known names for an
    /// unknown name.
    bool (*set)(CellChoice& choice, const std::string& word);
    /// Returns the value as result files store it: a number, a boolean or a string.
    Json (*get)(const CellChoice& choice);
    /// Whether the value must be 0 or a power of two. In an experiment, a wrong value skips the cell and is no error of the file.
    bool is_power_of_two = false;
};

/// Returns every option, in the order in which they are applied. To add an option, add a line to the table.
std::span<const Choice> choices();

/// Sets the option from a word. Throws BadUsage if the value is not allowed; the message is the same for all sources.
void choose(const Choice& option, CellChoice& choice, const std::string& word);

/// Sets the options of `of` whose keys are in `json`; ignores other keys. Throws BadUsage.
void read_choices(const Json& json, Choice::Of of, CellChoice& choice);

/// Returns `others` followed by the keys of the options of `of`.
std::vector<std::string_view> choice_keys(Choice::Of of,
                                          std::initializer_list<std::string_view> others);

/// Returns an object of all options of `of` with their values.
Json choices_json(const CellChoice& choice, Choice::Of of);

/// Adds the options for which `wanted` returns true to a command. Parsing sets `choice`, whose values are the defaults.
void add_choices(CLI::App& command, CellChoice& choice,
                 const std::function<bool(const Choice&)>& wanted);

/// Throws BadUsage if a number that must be a power of two is not.
void check_powers(const CellChoice& choice);

/// Throws BadUsage for an unknown builder or collider, boxes that the builder or leaves do not allow, or a wrong narrow phase.
void check_choice(const CellChoice& choice);

}  // namespace bvhbench
