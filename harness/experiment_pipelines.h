// SPDX-License-Identifier: MIT
#pragma once

#include "harness/collide.h"
#include "harness/json_keys.h"

namespace bvhbench {

/// What an experiment with `pipelines` measures, a task a scene. A scene is text or an object of
///
///     scene, frames ("a:b"), between, objects, pairs_of, swept (true: from each frame to the next, harness/swept.h)
///
/// and a pipeline an object of
///
///     collider    a name, or an object of name, jump, start_level, group_size
///     builder     as in other experiments; without, the collider wants no tree
///     pairs_of    all, between or within, unless the scene says which; adjacent: keep or drop; narrow: none, exact or a name of `list narrow`
///     no_skip     a rule of collide/skips.h that is not used, or "all"
///
/// Lists of colliders and builders mean each with each.
///
/// Throws BadUsage.
std::vector<CollideTask> collisions_of(const Json& json, const std::string& experiment, bool quick);

/// A collider's name, or an object of it and its options. Throws BadUsage.
ColliderChoice collider_choice(const Json& json);

}  // namespace bvhbench
