// SPDX-License-Identifier: MIT
#ifndef BVHBENCH_GEOMETRY_SCENE_BOUNDS_H
#define BVHBENCH_GEOMETRY_SCENE_BOUNDS_H

#include "geometry/triangle.h"

SHARED_BEGIN

/// What codes are measured against: the box of a whole scene and the box of its boxes' centres. 48 bytes.
typedef struct {
    Aabb scene;
    Aabb centres;
} Bounds;

/// The centre of a box, without negative zeros.
///
/// Halved before they are added, so that no coordinate a float can hold overflows. Only denormals lose a
/// bit by that. Two negative denormals may halve to -0; adding +0 makes it +0 (see triangle_box).
SHARED_FN Point box_centre(Aabb box)
{
    Point centre;
    centre.x = 0.5f * box.min_x + 0.5f * box.max_x + 0.0f;
    centre.y = 0.5f * box.min_y + 0.5f * box.max_y + 0.0f;
    centre.z = 0.5f * box.min_z + 0.5f * box.max_z + 0.0f;
    return centre;
}

/// The bounds of no box at all.
SHARED_FN Bounds empty_bounds(void)
{
    const Bounds bounds = {empty_box(), empty_box()};
    return bounds;
}

/// `bounds` grown to hold one more box and its centre.
SHARED_FN Bounds grown(Bounds bounds, Aabb box)
{
    const Point centre = box_centre(box);
    const Aabb at = {centre.x, centre.y, centre.z, centre.x, centre.y, centre.z};
    bounds.scene = merged(bounds.scene, box);
    bounds.centres = merged(bounds.centres, at);
    return bounds;
}

/// The bounds of two sets of boxes together. Smallest and largest do not depend on the order of joining.
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
