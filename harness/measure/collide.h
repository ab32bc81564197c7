// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "collide/pairs.h"
#include "harness/choice/scene_choice.h"
#include "harness/measure/contest.h"
#include "harness/measure/pipeline.h"
#include "harness/record/record.h"
#include "harness/session/session.h"

namespace bvhbench {

/// Pairs and contacts that a pipeline found in a frame, in canonical order. Triangles are numbered as in the scene's file. Lists
/// that agree with the oracle's are empty unless `wants_lists`.
struct Found {
    const Scene* scene = nullptr;  ///< valid only during the call
    PairList pairs = {}, contacts = {};
    /// Of contacts between two frames: a time before which each does not touch.
    std::vector<float> times = {};
    /// Vertices and faces, or edges, by which pairs are numbered; empty: triangles.
    std::span<const Face> features = {};
};

/// Returns the task's scene, with its objects split as chosen and the frames in between added. Throws what loading it throws.
Scene scene_of(const CollideTask& task, const SceneLibrary& library);

/// Returns the task's range of a scene's `there` frames. Throws BadUsage, naming them `what`, if the range does not fit.
FrameRange frames_of(const CollideTask& task, std::size_t there, const char* what);

SceneFacts facts_of(const CollideTask& task, const Scene& scene, std::size_t frame);

/// Returns what notes the `k`-th of a task's `count` frames or steps, named `what`.
Note note_of(const CollideTask& task, const std::string& what, std::size_t k, std::size_t count);

/// Returns a cell that names the task, builder and collider and has no measurements yet.
Cell planned_cell(const CollideTask& task, const PipelineChoice& pipeline);

/// Takes the cells of a frame, and what the last pipeline found in that frame.
using AddFrame = std::function<void(std::vector<Cell>&& cells, const Found& found)>;

/// Returns true if the run already has the next `cells` cells, which are then not measured again. May be empty.
using PassCells = std::function<bool(std::size_t cells)>;

/// Runs every pipeline over every frame, one cell each. The pipelines of a frame are checked against the oracles, then sampled
/// interleaved; a sample is a whole frame, from vertices to pairs or contacts. Each sample increments `order`.
///
/// A pipeline that fails leaves a cell with the reason. If the scene or frame does not exist, or if all pipelines look for pairs
/// between objects and the scene has one object, every pipeline leaves such a cell. Frames finished before reach `add`.
void collide_frames(Session& session, const CollideTask& task, int& order, const AddFrame& add,
                    const PassCells& passes = {});

/// Runs a task that has features: `swept`, whose boxes enclose them over a step, from one frame to the next, as in the broad phase of
/// continuous collision detection, or `features`, those within a distance in each frame. A step or frame has two queries, each with
/// one cell per pipeline: vertices against faces, which are two objects, and edges against edges, which are one object. A pipeline
/// limited to pairs between or within objects runs only one of them. Pairs that share a vertex are left out.
///
/// Cells of steps are checked against the sweep, and against the ground truth of the step if there is one (scenes/ground_truth.h):
/// counters ground_truth_pairs, ground_truth_missed and reference_pairs_count, the number of pairs in meta.json. Cells of frames are
/// checked against exact distances.
///
/// Throws BadUsage for options that make no sense with features, and Unavailable for steps of a scene of one frame.
void collide_features(Session& session, const CollideTask& task, int& order, const AddFrame& add,
                      const PassCells& passes);

/// A pipeline that runs over the frames of a scene. It is created when it first runs.
struct PipelineState {
    PipelineChoice choice;
    std::unique_ptr<Pipeline> pipeline = nullptr;
    Cell::Status status = Cell::Status::measured;  ///< status of its cell in the last frame
    std::string reason = {};                       ///< why it was not measured there
};

/// A frame that several pipelines run over.
struct FrameOfPipelines {
    const Input& input;
    Contest& contest;    ///< between the pipelines, over the scene's frames
    std::string number;  ///< path of the frame within the run, such as "2/0"
    SceneFacts scene;
    FeatureFacts features = {};
    std::vector<Motion> motions = {};       ///< since the previous frame; empty: unknown
    std::span<const uint> file_faces = {};  ///< as Scene::file_faces
    Note note = {};
    bool wants_lists = false;  ///< as in CollideTask
    /// Judges what a pipeline found, in addition to the oracles; may be empty.
    std::function<void(const Found& found, Cell& cell)> judge_more = {};
};

/// Runs all pipelines over a frame, one cell each: prepares and checks each, samples all interleaved, checks again. Writes the
/// last pipeline's result to `found`. A pipeline that fails has the same reason in the cells of all later frames.
std::vector<Cell> run_frame(Session& session, const CollideTask& task, std::span<PipelineState> all,
                            const FrameOfPipelines& frame, int& order, Found& found);

/// Returns a small scene as JSON, for a report that draws it in three dimensions. It has the tree that a builder left over the
/// frame's triangles as one object, and the pairs and contacts that a collider found in that tree, checked against the oracles:
///
/// {"run": {...}, "cell": {...}, "points": [x,y,z,...], "faces": [a,b,c,...], "levels": [{"leaves": n, "boxes": [...]}],
/// "pairs": [a,b,...], "contacts": [a,b,...]}
///
/// "run" and "cell" are as in a result file, without samples; the rest are flat lists. A level has the nodes of one depth: six
/// numbers a box (min x, y, z, max x, y, z), inner nodes first, then leaves. "levels" is empty if the tree is invalid.
///
/// Throws BadUsage for a scene that is too large and for a collider without a tree, Unavailable if the pipeline fails.
std::string view_text(Session& session, const std::string& scene, std::size_t frame,
                      const PipelineChoice& pipeline, std::vector<std::string> command);

}  // namespace bvhbench
