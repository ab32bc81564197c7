// SPDX-License-Identifier: MIT
//
// Meshes of exactly N triangles. All are deterministic: the same N gives the same mesh. What uses sin and
// cos (torus, sphere) may differ in a last bit between C libraries; the others use only +, -, *, / and
// square root, which IEEE 754 fixes.
#pragma once

#include "geometry/mesh.h"

namespace bvhbench {

/// A bumpy torus, an evenly tessellated closed surface: the usual stand-in for a scanned model.
/// Vertices at the two seams are not shared.
Mesh make_torus(uint triangles);

/// A sphere of rings of nearly equal triangles; closed when `triangles` is even and at least 6.
Mesh make_sphere(uint triangles);

/// A flat sheet in z = 0: boxes without volume that touch exactly.
Mesh make_grid(uint triangles);

/// A ball of long thin curling strands: boxes overlap far more than triangles do.
Mesh make_hairball(uint triangles);

/// Small random triangles in the unit cube that share no vertices. `triangles` <= 2^32 / 3.
Mesh make_soup(uint triangles);

}  // namespace bvhbench
