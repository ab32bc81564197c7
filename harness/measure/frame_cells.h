// SPDX-License-Identifier: MIT
//
// One frame by several pipelines: what frames of a scene and swept steps between them have in common.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "harness/measure/collide.h"
#include "harness/measure/pipeline.h"

namespace bvhbench {

/// A pipeline through the frames of a scene: made when it is first run.
struct Running {
    PipelineChoice choice;
    std::unique_ptr<Pipeline> pipeline = nullptr;
    std::string failure = {};  ///< why there is none, or none any more
    bool cannot_be = false;  ///< whether that is because there is no such pipeline over this scene
};

/// A frame that pipelines are run over.
struct FrameOfPipelines {
    const Input& input;
    std::string number;  ///< which of the run's frames it is
    SceneFacts scene;
    SweptFacts swept = {};
    std::vector<Motion> motions = {};  ///< since the frame before, if that is known
    std::span<const uint> file_faces =
        {};  ///< by which numbers triangles are shown (Scene::file_faces)
    /// What else to hold to what a pipeline found, besides the oracles.
    std::function<void(const Found& found, Cell& cell)> judge_more = {};
};

/// The answer was wrong, and why; more than one reason may be.
void find_wrong(Check& check, const std::string& detail);

/// All pipelines over a frame, a cell each: settled, held to the oracles, sampled interleaved, and held to them again. What
/// the last one found goes to `found`. One that fails says so, now and in all frames after.
std::vector<Cell> run_frame(Session& session, const CollideTask& task, std::span<Running> all,
                            const FrameOfPipelines& frame, int& order, Found& found);

}  // namespace bvhbench
