// SPDX-License-Identifier: MIT
#pragma once

#include "harness/base/json_keys.h"
#include "harness/choice/scene_choice.h"

namespace bvhbench {

/// Returns the scene's name, or one name per size for an object of `scene` and sizes. All functions here throw BadUsage.
std::vector<std::string> scene_names(const Json& json);

/// Returns the builder at `key`, or those of the list there: each a name, or an object of its name and options.
std::vector<BuilderChoice> builder_choices(const Json& json, const char* key = "builders");

/// Returns the tasks of an experiment with `pipelines`, one per scene.
std::vector<CollideTask> collisions_of(const Json& json, const std::string& experiment, bool quick);

}  // namespace bvhbench
