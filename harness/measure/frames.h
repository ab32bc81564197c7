// SPDX-License-Identifier: MIT
#pragma once

#include "harness/choice/experiment.h"
#include "harness/record/record.h"
#include "harness/session/session.h"

namespace bvhbench {

/// A scene, and the frames of it that an experiment's cells need on the device.
///
/// Where nothing is refitted that is the first frame. Where something is, the points have moved: every cell is
/// about the second frame, be its tree built over it or built over the first and refitted.
class Frames {
public:
    /// Read the scene. Throws what load_scene does, and Unavailable when it has no second frame to refit to.
    void load(const Experiment& experiment, const std::string& name, const SceneLibrary& library);

    SceneFacts facts() const;

    /// Copy to the device, as one object or, `by_objects`, as those that the scene names. Waits. The frames stay where
    /// they are from now on.
    void upload(Session& session, bool by_objects = false);

    const Input& now() const { return now_; }  ///< what trees must be over in the end
    const Input& before() const
    {
        return before_;
    }  ///< only for refits: what trees were over before

private:
    Scene scene_;
    std::vector<Face>
        file_faces_;  ///< those of a scene whose triangles are in another order, as one object
    std::string name_;
    std::size_t frame_ = 0;
    Input now_, before_;
};

}  // namespace bvhbench
