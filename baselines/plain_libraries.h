// SPDX-License-Identifier: MIT
//
// Libraries as their manuals show them, without the care that our colliders take of them: what `bvhbench stress` finds
// out about them. They may crash, hang, or take all memory: to be called in a process of its own.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "collide/pairs.h"
#include "geometry/mesh.h"

namespace bvhbench {

struct PlainLibrary {
    std::string_view name;     ///< the key in tables and result files
    std::string_view library;  ///< whose version it has: a name of the run's libraries
    /// Whether it finds pairs of triangles that intersect and share no vertex; else of boxes that overlap.
    bool finds_contacts;
    /// Of two objects the pairs between them, of one its pairs with itself, in any order.
    std::vector<Pair> (*find)(std::span<const Point> points, std::span<const Face> faces,
                              std::span<const FaceRange> objects);
};

/// Those that the program was built with.
std::span<const PlainLibrary> plain_libraries();

/// Each library's, defined where it was built with it.
std::vector<PlainLibrary> plain_embree();
std::vector<PlainLibrary> plain_fcl();

}  // namespace bvhbench
