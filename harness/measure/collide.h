// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "collide/pairs.h"
#include "harness/choice/collide_task.h"
#include "harness/record/record.h"
#include "harness/session/session.h"

namespace bvhbench {

/// What a pipeline found in a frame, in canonical order, by the numbers triangles have in the file.
struct Found {
    PairList pairs, contacts;
    const Scene* scene = nullptr;  ///< it is there while these are handed on
};

/// The task's scene, with its objects and the frames between. Throws what loading it does.
Scene scene_of(const CollideTask& task, const SceneLibrary& library);

/// The task's range of the `there` frames of a scene; `what` names them in the error. Throws BadUsage.
FrameRange frames_of(const CollideTask& task, std::size_t there, const char* what);

SceneFacts facts_of(const CollideTask& task, const Scene& scene, std::size_t frame);

/// Every pipeline over every frame, a cell each: checked against the oracles, then sampled, all of a frame
/// interleaved; each sample is a whole frame from vertices to pairs or contacts. `add` gets the cells of a frame once
/// it is done, and what the last pipeline found. `order` counts samples and goes on.
///
/// A pipeline that fails is a cell that says so, and so is each pipeline where there is no such scene or frame, or all of them
/// look for pairs between the objects of a scene that is one object. Frames done by then have been handed on. passes(n)
/// is true if the n cells of the scene exist already; then nothing is done.
void collide_frames(Session& session, const CollideTask& task, int& order,
                    const std::function<void(std::vector<Cell>&&, const Found&)>& add,
                    const std::function<bool(std::size_t cells)>& passes = {});

}  // namespace bvhbench
