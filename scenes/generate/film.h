// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "scenes/generate/vector.h"
#include "scenes/scene.h"

namespace bvhbench {

/// Collects what moves and where it is at each frame.
class Film {
public:
    /// Where a point of the mesh is now.
    using Place = std::function<Vector(Point)>;
    void add(std::string name, Mesh mesh, Place place);

    /// The scene of `frames` moments, equally far apart, of `steps` steps; the last is after the last step. The
    /// same steps whatever the number of frames. `advance` is told how many were made.
    Scene shoot(uint frames, uint steps, const std::function<void(uint step)>& advance) const;

private:
    struct Actor {
        std::string name;
        Mesh mesh;
        Place place;
    };
    std::vector<Actor> actors_;
};

/// `total` shared among `parts` as evenly as can be, each share but the last even if there are two for each: a
/// closed surface has an even number of triangles.
std::vector<uint> even_shares(uint total, uint parts);

/// `share` of `total`, even, at least 1 and such that `rest` are left.
uint even_part(uint total, double share, uint rest);

}  // namespace bvhbench
