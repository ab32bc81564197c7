// SPDX-License-Identifier: MIT
#pragma once

#include "harness/record/record.h"
#include "harness/session/session.h"

namespace bvhbench {

/// Returns the scene `name`, or with `may_stand_in` the stand-in of a missing data set. Throws as load_scene.
Scene scene_called(const std::string& name, bool may_stand_in, const SceneLibrary& library);

/// Returns the facts of frame `frame` of a scene that was asked for as `name`.
SceneFacts facts_of(const Scene& scene, std::string name, std::size_t frame);

/// Uploads a frame, with the scene's objects or as one object. Blocks until done.
Input upload_frame(Session& session, const Scene& scene, std::size_t frame, bool by_objects = true);

}  // namespace bvhbench
