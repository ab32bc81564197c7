// SPDX-License-Identifier: MIT
// check: -DPOSITION_BITS=11u -DCODE_WORDS=1 -DSEVERAL_OBJECTS=1
// check: -DPOSITION_BITS=24u -DCODE_WORDS=2 -DSEVERAL_OBJECTS=1
// check: -DPOSITION_BITS=20u -DCODE_WORDS=1 -DSEVERAL_OBJECTS=0
//
// What is before and after the sort of boxes (sort_sweep.cpp). A code is the number of a box's object, and below it the cell in which the
// box begins along the object's axis.
#include "collide/object_order.clh"
#include "collide/worlds/sweep.clh"
#include "geometry/split.h"

/// A part of space along an axis, cut into 2^POSITION_BITS cells: about the centres of an object along the longest side of their box. The
/// first and the last cell have all that is beyond. A cell's number never falls where the coordinate rises.
typedef struct {
    uint axis;
    float half_low, scale;
} Ruler;

static inline Ruler ruler_over(const Aabb centres)
{
    const uint axis = widest_axis(centres);
    const float half_low = 0.5f * begin_of(centres, axis);  // half, since a length may overflow
    const float half_length = 0.5f * end_of(centres, axis) - half_low;
    const float cells = (float)(1u << POSITION_BITS);
    const Ruler ruler = {axis, half_low, fmin(cells / half_length, 8.507059173e+37f)};
    return ruler;
}

static inline uint cell_of(const Ruler ruler, const float x)
{
    const float most = (float)((1u << POSITION_BITS) - 1u);
    return (uint)fmin(fmax((0.5f * x - ruler.half_low) * ruler.scale, 0.0f), most);
}

static inline Code code_of(const uint object, const uint cell)
{
#if SEVERAL_OBJECTS
    return (Code)object << POSITION_BITS | cell;
#else
    (void)object;
    return cell;
#endif
}

/// Writes the code of each box. `bounds`: of each object.
kernel void begin_codes(global const float2* restrict boxes, global const Bounds* restrict bounds,
                        global const uint* restrict owners, global Code* restrict codes,
                        const uint count)
{
    const uint k = (uint)get_global_id(0);
    if (k >= count)
        return;
    const uint object = SEVERAL_OBJECTS ? owners[k] : 0u;
    const Ruler ruler = ruler_over(bounds[object].centres);
    codes[k] = code_of(object, cell_of(ruler, begin_of(load_box(boxes, k), ruler.axis)));
}

/// Writes the boxes in their order, as six rows of sides, `row_length` apart, and for each the code of where it ends. An object's boxes are
/// in the places that its triangles have in the mesh.
kernel void place_boxes(global const float2* restrict boxes, global const Bounds* restrict bounds,
                        global const uint* restrict owners, global const uint* restrict lined_up,
                        global float* restrict sides, global Code* restrict ends, const uint count,
                        const uint row_length)
{
    const uint place = (uint)get_global_id(0);
    if (place >= count)
        return;
    const uint object = SEVERAL_OBJECTS ? owners[place] : 0u;
    const Ruler ruler = ruler_over(bounds[object].centres);
    const Aabb box = load_box(boxes, lined_up[place]);
    const float all[6] = {box.min_x, box.min_y, box.min_z, box.max_x, box.max_y, box.max_z};
    for (uint k = 0u; k < 6u; ++k)
        sides[k * (ulong)row_length + place] = all[k];
    ends[place] = code_of(object, cell_of(ruler, end_of(box, ruler.axis)));
}
