// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "scenes/generate/vector.h"
#include "scenes/scene.h"

namespace bvhbench {

/// Collects moving meshes and records their positions at each frame.
class Film {
public:
    /// Returns the current position of a point of the mesh.
    using Place = std::function<Vector(Point)>;
    void add(std::string name, Mesh mesh, Place place);

    /// Returns a scene of `frames` frames at equal intervals within `steps` steps; the last frame is after the last step. The
    /// steps do not depend on the number of frames. `advance` gets the number of steps made so far.
    Scene shoot(uint frames, uint steps, const std::function<void(uint step)>& advance) const;

private:
    struct Actor {
        std::string name;
        Mesh mesh;
        Place place;
    };
    std::vector<Actor> actors_;
};

/// Divides `total` among `parts` as evenly as possible. Each share but the last is even if there are at least two for each,
/// because a closed surface has an even number of triangles.
std::vector<uint> even_shares(uint total, uint parts);

/// Returns about `share` of `total` as an even number, clamped to at least 1 and such that at least `rest` remain.
uint even_part(uint total, double share, uint rest);

}  // namespace bvhbench
