// SPDX-License-Identifier: MIT
#pragma once

#include "harness/base/json_keys.h"
#include "harness/choice/scene_choice.h"

namespace bvhbench {

/// A scene's name, or each size of an object of `scene` and the sizes that it names. Throws BadUsage, as all here.
std::vector<std::string> scene_names(const Json& json);

/// A builder's name, or an object of it and its options.
BuilderChoice builder_choice(const Json& json);

/// What an experiment with `pipelines` measures, a task a scene. A scene is text or an object of `scene`, the options of scenes
/// (harness/choice/choices.h), and pairs_of for all pipelines. A pipeline is an object of
///
///     collider    a name, or an object of name and the options of colliders
///     builder     as in other experiments; without, the collider wants no tree
///
/// and the options of queries. Lists of colliders and builders mean each with each.
std::vector<CollideTask> collisions_of(const Json& json, const std::string& experiment, bool quick);

}  // namespace bvhbench
