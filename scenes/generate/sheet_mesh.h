// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/mesh.h"

namespace bvhbench {

/// A sheet of exactly `triangles` over the unit square, its points at (u, v, 0): about `aspect` times as many
/// quads along u as along v, cut in two each, row by row; the last row may stop before its end. `closed`: what
/// is at u = 1 is at u = 0. Every point is a corner of some triangle.
Mesh make_sheet(uint triangles, double aspect, bool closed);

}  // namespace bvhbench
