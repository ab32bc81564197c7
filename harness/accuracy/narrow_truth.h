// SPDX-License-Identifier: MIT
#pragma once

#include "collide/pairs.h"
#include "geometry/mesh.h"

namespace bvhbench {

/// Of a mesh made of pairs, triangles 0 and 1, 2 and 3 and so on: those pairs, and those of them that intersect by CGAL's
/// exact predicates, on all cores of the host. Throws Unavailable in a build without CGAL.
std::vector<Pair> pairs_of_neighbours(const Mesh& mesh);
PairList neighbours_that_meet(const Mesh& mesh);

}  // namespace bvhbench
