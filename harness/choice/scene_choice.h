// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "harness/base/terminal.h"
#include "harness/choice/catalog.h"
#include "harness/choice/sampling.h"
#include "scenes/face_order.h"

namespace bvhbench {

/// A builder, and the collider that queries its trees.
struct PipelineChoice {
    BuilderChoice builder;
    ColliderChoice collider;
    bool operator==(const PipelineChoice&) const = default;
};

/// Returns each pipeline and, behind it, one for each rule that may shorten its frames, without only that rule. If some device does
/// without the rule by default (collide/skips.cpp), another one with the rule forced follows. The last has none of the rules.
std::vector<PipelineChoice> with_each_rule_off(const std::vector<PipelineChoice>& pipelines);

/// Frames [first, end) of a scene, counted after the frames between were inserted.
struct FrameRange {
    std::size_t first = 0;
    std::size_t end = 1;  ///< 0: up to the last frame
    bool operator==(const FrameRange&) const = default;
};

/// Parses "a:b" (frames [a, b)), "a:" (from a to the last) or "a" (only a). Throws BadUsage.
FrameRange frame_range(const std::string& text);
std::string frame_range_text(const FrameRange& range);

/// Options of a scene besides its name.
struct SceneChoice {
    ObjectsBy objects = ObjectsBy::automatic;
    unsigned between = 0;      ///< frames inserted between consecutive frames of the scene
    bool swept = false;        ///< boxes enclose the motion from each frame to the next
    bool features = false;     ///< pairs are of vertices and faces, and of edges, in each frame
    std::string exclude = {};  ///< objects that are not tested with each other (filter_words.h)
    FrameRange frames = {};    ///< if swept: the frames in which motions begin

    /// True if pairs are of vertices and faces, and of edges: over each step, or in each frame.
    bool has_features() const { return swept || features; }

    bool operator==(const SceneChoice&) const = default;
};

/// A scene, the pipelines that collide it, and how often each is sampled.
struct CollideTask : SceneChoice {
    std::string experiment = "collide";
    std::string number = "0";  ///< index of the scene in the run
    std::string scene;
    bool may_stand_in = false;
    bool needs_scene = false;  ///< as in Experiment
    std::vector<PipelineChoice> pipelines;
    int samples = 20;
    int warm_up = 3;
    SamplingRules sampling = {};
    /// Of the trees that are queried; nothing: not computed.
    std::optional<NodeCosts> quality = {};
    bool wants_lists = false;  ///< what is found is listed, even if it is known to be right
    Note note = {};            ///< told before and during work that takes long; may be empty
};

/// Throws BadUsage for options that are invalid with features, or without. Needs no scene.
void check_features(const CollideTask& task);

}  // namespace bvhbench
