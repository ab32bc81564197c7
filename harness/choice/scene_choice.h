// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "harness/choice/catalog.h"
#include "harness/choice/collider_catalog.h"
#include "harness/choice/sampling.h"
#include "scenes/face_order.h"

namespace bvhbench {

/// A builder and the collider over its trees.
struct PipelineChoice {
    BuilderChoice builder;
    ColliderChoice collider;
    bool operator==(const PipelineChoice&) const = default;
};

/// Frames of a scene, from `first` to before `end`, counted after those between were put in.
struct FrameRange {
    std::size_t first = 0;
    std::size_t end = 1;  ///< 0: all there are
    bool operator==(const FrameRange&) const = default;
};

/// "a:b", a to before b; "a:", to the last; "a", that one. Throws BadUsage.
FrameRange frame_range(const std::string& text);
std::string frame_range_text(const FrameRange& range);

/// What is asked of a scene besides its name.
struct SceneChoice {
    ObjectsBy objects = ObjectsBy::automatic;
    unsigned between = 0;    ///< frames put between each two of the scene's
    bool swept = false;      ///< boxes are around the way from each frame to the next
    FrameRange frames = {};  ///< swept: those that ways begin in
};

/// What is collided, and how often it is measured.
struct CollideTask : SceneChoice {
    std::string experiment = "collide";
    std::string number = "0";  ///< which of the run's scenes it is
    std::string scene;
    bool may_stand_in = false;
    bool needs_scene = false;  ///< as an Experiment's
    std::vector<PipelineChoice> pipelines;
    int samples = 20;
    int warm_up = 3;
    SamplingRules sampling = {};
    /// Told what is being done where that takes long, for a line of progress; may be empty.
    std::function<void(const std::string& what)> note = {};
};

/// What has no meaning with swept boxes, before anything is loaded. Throws BadUsage.
void check_swept(const CollideTask& task);

}  // namespace bvhbench
