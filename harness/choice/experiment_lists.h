// SPDX-License-Identifier: MIT
#pragma once

#include "harness/base/json_keys.h"
#include "harness/choice/scene_choice.h"

namespace bvhbench {

/// Returns the scene's name, or one name per size for an object of `scene` and sizes. All functions here throw BadUsage.
std::vector<std::string> scene_names(const Json& json);

/// Reads a builder's name, or an object of its name and options.
BuilderChoice builder_choice(const Json& json);

/// Returns the tasks of an experiment with `pipelines`, one per scene. A scene is a string, or an object of `scene`, the options
/// of scenes (harness/choice/choices.h), and `pairs_of`, which applies to all pipelines. A pipeline is an object of
///
///     collider    a name, or an object of `name` and the options of colliders
///     builder     as in other experiments; may be missing if the collider needs no tree
///
/// and the options of queries. Lists of builders and colliders make one pipeline for each combination.
std::vector<CollideTask> collisions_of(const Json& json, const std::string& experiment, bool quick);

}  // namespace bvhbench
