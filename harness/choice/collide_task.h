// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/choice/sampling.h"
#include "harness/choice/scene_choice.h"

namespace bvhbench {

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
