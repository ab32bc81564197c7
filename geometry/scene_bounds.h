// SPDX-License-Identifier: MIT
#ifndef BVHBENCH_GEOMETRY_SCENE_BOUNDS_H
#define BVHBENCH_GEOMETRY_SCENE_BOUNDS_H

#include "geometry/triangle.h"

SHARED_BEGIN

/// Bounds that Morton and Hilbert codes are computed in: the box of the scene and the box of all box centres. 48 bytes.
typedef struct {
    Aabb scene;
    Aabb centres;
} Bounds;

/// Returns the centre of a box, without negative zeros.
///
/// Halves both sides before adding, so that no coordinate overflows; only denormals lose a bit. Two negative denormals may halve to -0;
/// adding +0 makes it +0 (see triangle_box).
SHARED_FN Point box_centre(Aabb box)
{
    Point centre;
    centre.x = 0.5f * box.min_x + 0.5f * box.max_x + 0.0f;
    centre.y = 0.5f * box.min_y + 0.5f * box.max_y + 0.0f;
    centre.z = 0.5f * box.min_z + 0.5f * box.max_z + 0.0f;
    return centre;
}

/// Returns the bounds of an empty set of boxes.
SHARED_FN Bounds empty_bounds(void)
{
    const Bounds bounds = {empty_box(), empty_box()};
    return bounds;
}

/// Returns `bounds` extended by a box and its centre.
SHARED_FN Bounds grown(Bounds bounds, Aabb box)
{
    const Point centre = box_centre(box);
    const Aabb at = {centre.x, centre.y, centre.z, centre.x, centre.y, centre.z};
    bounds.scene = merged(bounds.scene, box);
    bounds.centres = merged(bounds.centres, at);
    return bounds;
}

/// Returns the common bounds of two sets of boxes. Minimum and maximum do not depend on the order of joining.
SHARED_FN Bounds joined(Bounds a, Bounds b)
{
    a.scene = merged(a.scene, b.scene);
    a.centres = merged(a.centres, b.centres);
    return a;
}

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(bvhbench::Bounds) == 48);
#endif
#endif
