// SPDX-License-Identifier: MIT
#pragma once

#include "harness/choice/experiment.h"
#include "harness/record/record.h"
#include "harness/session/session.h"

namespace bvhbench {

/// The scene called so; if it is a data set that is not there, its stand-in, where there may be one. Throws as load_scene does.
Scene scene_called(const std::string& name, bool may_stand_in, const SceneLibrary& library);

/// What is known of a scene that was asked for as `name`.
SceneFacts facts_of(const Scene& scene, std::string name, std::size_t frame);

/// A frame on the device, an object for each of the scene's. Waits.
Input upload_frame(Session& session, const Scene& scene, std::size_t frame);

/// A scene, and the frames of it that an experiment's cells need on the device.
///
/// Where nothing is refitted that is the first frame. Where something is, the points have moved: every cell is
/// about the second frame, be its tree built over it or built over the first and refitted.
class Frames {
public:
    /// Read the scene. Throws what load_scene does, and Unavailable when it has no second frame to refit to.
    void load(const Experiment& experiment, const std::string& name, const SceneLibrary& library);

    SceneFacts facts() const { return facts_of(scene_, name_, frame_); }

    /// Copy to the device, as one object or, `by_objects`, as those that the scene names. Waits. The frames stay where
    /// they are from now on.
    void upload(Session& session, bool by_objects = false);

    const Input& now() const { return now_; }        ///< what trees must be over in the end
    const Input& before() const { return before_; }  ///< of refits: what trees were over before

private:
    Scene scene_;
    std::vector<Face> faces_;  ///< as one object, of a scene whose file has them in another order
    std::string name_;
    std::size_t frame_ = 0;
    Input now_, before_;
};

}  // namespace bvhbench
