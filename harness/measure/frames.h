// SPDX-License-Identifier: MIT
#pragma once

#include "harness/choice/experiment.h"
#include "harness/record/record.h"
#include "harness/session/session.h"

namespace bvhbench {

/// Returns the scene `name`, or with `may_stand_in` the stand-in of a missing data set. Throws as load_scene.
Scene scene_called(const std::string& name, bool may_stand_in, const SceneLibrary& library);

/// Returns the facts of frame `frame` of a scene that was asked for as `name`.
SceneFacts facts_of(const Scene& scene, std::string name, std::size_t frame);

/// Uploads a frame, with the scene's objects or as one object. Blocks until done.
Input upload_frame(Session& session, const Scene& scene, std::size_t frame, bool by_objects = true);

/// A scene, and those of its frames that an experiment needs on the device.
///
/// Without refits that is the first frame. With refits every cell is about the second frame, whose points have moved: its tree
/// is built over that frame, or built over the first and refitted.
class Frames {
public:
    /// Reads the scene. Throws what load_scene throws, and Unavailable if a refit is asked for and there is no second frame.
    void load(const Experiment& experiment, const std::string& name, const SceneLibrary& library);

    const SceneFacts& facts() const { return facts_; }  ///< of the scene as it was read

    /// Uploads the frames as one object. Blocks until done. The references that now() and before() return stay valid from now on.
    void upload(Session& session);

    /// Copies the points of that frame to the device once more. Waits.
    void upload_points(Session& session);

    const Input& now() const { return now_; }        ///< frame that cells are about
    const Input& before() const { return before_; }  ///< frame that trees are refitted from

private:
    Scene scene_;
    SceneFacts facts_;
    std::size_t frame_ = 0;
    Input now_, before_;
};

}  // namespace bvhbench
