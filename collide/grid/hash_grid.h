// SPDX-License-Identifier: MIT
//
// The arithmetic of a hierarchical hashed grid, on both sides.
//
// Level 0 has the finest cells, each level above cells of four times the side. A box belongs to the finest level whose
// cells are no shorter than its longest side, so it covers two cells along an axis, three where rounding has it so, and
// never more: what a large triangle costs is bounded, and small ones do not pay for it.
//
// No overlapping pair is missed, and each is met in one cell only:
//
//   - A coordinate becomes a cell by a multiplication, rounded to nearest, a floor and a clamp. Each never falls where
//     its argument rises, so neither does all of it: cell(x) is from cell(min) to cell(max) for every x in between.
//   - Two closed boxes overlap if and only if the lower corner of what they share, the larger of both mins on every axis,
//     is in both. Its cell is then among the cells of both, on every level, and is the only one that reports them.
//
// Coordinates are not taken relative to the scene's corner: near the origin floats are finer than anywhere, and
// subtracting a far corner would lose that.
#ifndef BVHBENCH_COLLIDE_HASH_GRID_H
#define BVHBENCH_COLLIDE_HASH_GRID_H

#include "geometry/aabb.h"

SHARED_BEGIN

#define HASH_LEVELS 16u
#define HASH_AXIS_BITS 9u

/// The grid of one frame. 8 bytes.
typedef struct {
    float scale;  // cells of level 0 a unit of length
    uint levels;  // bit L: there is a box of level L
} HashGrid;

/// The cells that a box covers, ends included.
typedef struct {
    int low_x, low_y, low_z, high_x, high_y, high_z;
} CellRange;

/// Cells of `level` a unit of length. By a power of two: exact, and where it underflows all of a level is one cell.
SHARED_FN float level_scale(float scale, uint level)
{
    return scale * as_float((127u - 2u * level) << 23u);
}

/// The cell of coordinate x. Clamped as a float, since converting what does not fit differs between devices.
SHARED_FN int cell_along(float x, float scale)
{
    const float limit = 1073741824.0f;
    const float at = fmin(fmax(x * scale, -limit), limit);
    const int whole = (int)at;
    return (float)whole > at ? whole - 1 : whole;
}

/// Half the longest side. Halved before it is subtracted, so that nothing overflows.
SHARED_FN float half_longest(Aabb box)
{
    const float x = 0.5f * box.max_x - 0.5f * box.min_x;
    const float y = 0.5f * box.max_y - 0.5f * box.min_y;
    const float z = 0.5f * box.max_z - 0.5f * box.min_z;
    return fmax(fmax(x, y), z);
}

/// The level a box belongs to. The last one takes all that is left: with cells no shorter than the mean side none is,
/// since a side is at most the sum of all, and there are fewer than 4^15 triangles.
SHARED_FN uint level_of_box(Aabb box, float scale)
{
    const float half_side = half_longest(box);
    uint level = 0u;
    while (level + 1u < HASH_LEVELS && half_side * level_scale(scale, level) > 0.5f)
        ++level;
    return level;
}

SHARED_FN CellRange cells_of_box(Aabb box, float scale)
{
    const CellRange range = {cell_along(box.min_x, scale), cell_along(box.min_y, scale),
                             cell_along(box.min_z, scale), cell_along(box.max_x, scale),
                             cell_along(box.max_y, scale), cell_along(box.max_z, scale)};
    return range;
}

/// The number of a cell. Space is rolled up: cells 512 apart along an axis have the same number, which the cells of one
/// box never do. So a box has one entry of a number at most, and equal numbers are as good as equal cells: a pair may
/// be tested where it need not, and is reported once.
SHARED_FN uint cell_number(uint level, int x, int y, int z)
{
    const uint mask = (1u << HASH_AXIS_BITS) - 1u;
    return ((((level << HASH_AXIS_BITS) | ((uint)z & mask)) << HASH_AXIS_BITS | ((uint)y & mask))
            << HASH_AXIS_BITS) |
           ((uint)x & mask);
}

SHARED_FN uint level_of_number(uint number) { return number >> 3u * HASH_AXIS_BITS; }

/// The number of the cell that reports two overlapping boxes on `level`.
SHARED_FN uint meeting_number(Aabb a, Aabb b, uint level, float scale)
{
    return cell_number(level, cell_along(fmax(a.min_x, b.min_x), scale),
                       cell_along(fmax(a.min_y, b.min_y), scale),
                       cell_along(fmax(a.min_z, b.min_z), scale));
}

/// The bucket of a number, of 2^(32 - shift) of them: multiplied by 2^32 over the golden ratio.
SHARED_FN uint bucket_of(uint number, uint shift) { return number * 2654435769u >> shift; }

// An entry of the table: a cell's number and one of its triangles, with the triangle's box, so that a walk along a cell
// reads one line of memory and fetches nothing from elsewhere. 32 bytes, in kernels two words:
//
//     min x, y, z, max x | max y, z, number, triangle
#ifdef __OPENCL_C_VERSION__

static inline void store_entry(global uint4* entries, const uint slot, const Aabb box,
                               const uint number, const uint triangle)
{
    entries[2ul * slot] =
        (uint4)(as_uint(box.min_x), as_uint(box.min_y), as_uint(box.min_z), as_uint(box.max_x));
    entries[2ul * slot + 1ul] = (uint4)(as_uint(box.max_y), as_uint(box.max_z), number, triangle);
}

static inline Aabb entry_box(const uint4 first, const uint4 second)
{
    const Aabb box = {as_float(first.x), as_float(first.y),  as_float(first.z),
                      as_float(first.w), as_float(second.x), as_float(second.y)};
    return box;
}

#define ENTRY_NUMBER(second) ((second).z)
#define ENTRY_TRIANGLE(second) ((second).w)

#else

struct GridEntry {
    Aabb box;
    uint number, triangle;
};
static_assert(sizeof(HashGrid) == 8 && sizeof(GridEntry) == 32);

#endif

SHARED_END

#endif
