// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "harness/choice/catalog.h"
#include "harness/choice/collider_catalog.h"
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
    unsigned between = 0;  ///< frames put between each two of the scene's
    bool swept =
        false;  ///< boxes are around the way from each frame to the next (harness/measure/swept.h)
    FrameRange frames = {};  ///< swept: those that ways begin in
};

}  // namespace bvhbench
