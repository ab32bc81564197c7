// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "collide/pairs.h"
#include "harness/choice/scene_choice.h"
#include "harness/measure/pipeline.h"
#include "harness/record/record.h"
#include "harness/session/session.h"

namespace bvhbench {

/// What a pipeline found in a frame, in canonical order, by the numbers triangles have in the file.
struct Found {
    const Scene* scene = nullptr;  ///< it is there while these are handed on
    PairList pairs = {}, contacts = {};
};

/// The task's scene, with its objects and the frames between. Throws what loading it does.
Scene scene_of(const CollideTask& task, const SceneLibrary& library);

/// The task's range of the `there` frames of a scene; `what` names them in the error. Throws BadUsage.
FrameRange frames_of(const CollideTask& task, std::size_t there, const char* what);

SceneFacts facts_of(const CollideTask& task, const Scene& scene, std::size_t frame);

/// A cell of the task of which nothing is known yet.
Cell planned_cell(const CollideTask& task, const PipelineChoice& pipeline);

/// Takes the cells of a frame, and what the last pipeline found in it.
using AddFrame = std::function<void(std::vector<Cell>&& cells, const Found& found)>;

/// Whether so many cells exist already, which then are not measured again. May be empty: they do not.
using PassCells = std::function<bool(std::size_t cells)>;

/// Every pipeline over every frame, a cell each: checked against the oracles, then sampled, all of a frame
/// interleaved; each sample is a whole frame from vertices to pairs or contacts. `order` counts samples and goes on.
///
/// A pipeline that fails is a cell that says so, and so is each pipeline where there is no such scene or frame, or all of them
/// look for pairs between the objects of a scene that is one object. Frames done by then have been handed on.
void collide_frames(Session& session, const CollideTask& task, int& order, const AddFrame& add,
                    const PassCells& passes = {});

/// The same of a task whose `swept` is set, over boxes swept between two frames, the broad phase of continuous collision
/// detection. A step from a frame to the next is two queries, a cell a pipeline each: vertices against faces, whose objects these
/// are, and edges against each other, which are one object. A pipeline has both unless its pairs are those between
/// objects, or within. Pairs that share a vertex are left out.
///
/// A cell is held to the sweep, and where the scene's folder says more of a step (scenes/ground_truth.h) to that: counters
/// ground_truth_pairs and ground_truth_missed, and reference_pairs_count, how many pairs its meta.json counts.
///
/// Throws BadUsage for what has no meaning with swept boxes, and Unavailable for a scene of one frame.
void collide_swept(Session& session, const CollideTask& task, int& order, const AddFrame& add,
                   const PassCells& passes);

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
    std::vector<Motion> motions = {};       ///< since the frame before, if that is known
    std::span<const uint> file_faces = {};  ///< numbers of triangles (Scene::file_faces)
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
