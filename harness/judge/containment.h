// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "collide/pairs.h"
#include "scenes/scene.h"

namespace bvhbench {

/// Objects of a frame that lie inside others, and how many objects nothing can be inside of, because they are not closed.
struct Containment {
    std::vector<std::pair<std::size_t, std::size_t>> found;  ///< an object, and the one around it
    std::size_t open_objects = 0;
};

/// Returns which objects lie wholly inside a closed object that they have no contact and no vertex in common with. An object is closed if each of its edges
/// belongs to an even number of its triangles. `contacts` are all exact contacts between objects, numbered as in the file. Decides by
/// whether a ray crosses the closed object's surface an odd number of times, exactly.
Containment containment(const Scene& scene, std::size_t frame, std::span<const Pair> contacts);

}  // namespace bvhbench
