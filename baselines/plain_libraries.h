// SPDX-License-Identifier: MIT
//
// Collision libraries called as their manuals show, without the workarounds of our colliders, for `bvhbench stress`. The calls
// may crash, hang, or exhaust memory: make them in a separate process.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "collide/pairs.h"
#include "geometry/mesh.h"

namespace bvhbench {

struct PlainLibrary {
    std::string_view name;     ///< the key in tables and result files
    std::string_view library;  ///< name of the library, as among the run's library versions
    /// True: finds pairs of triangles that intersect and share no vertex. False: finds pairs of overlapping boxes.
    bool finds_contacts;
    /// Returns, in any order, the pairs between two objects or, given one object, its pairs with itself.
    std::vector<Pair> (*find)(std::span<const Point> points, std::span<const Face> faces,
                              std::span<const FaceRange> objects);
};

/// Returns the libraries that the program was built with.
std::span<const PlainLibrary> plain_libraries();

// Each is defined only if the program was built with the library.
std::vector<PlainLibrary> plain_embree();
std::vector<PlainLibrary> plain_fcl();

}  // namespace bvhbench
