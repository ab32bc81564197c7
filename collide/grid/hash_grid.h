// SPDX-License-Identifier: MIT
//
// Arithmetic of a hierarchical hashed grid, for host and device.
//
// Level 0 has the finest cells; the cells of each further level are four times as long. A box belongs to the finest level whose
// cells are no shorter than its longest side. So it covers at most two cells along an axis, three in case of rounding: the cost
// of a large triangle is bounded, and small triangles do not pay for it.
//
// No overlapping pair is missed, and each is reported in exactly one cell:
//
//   - A coordinate is mapped to a cell by a multiplication rounded to nearest, a floor and a clamp. Each is monotonic, so the
//     whole is: cell(x) lies between cell(min) and cell(max) for every x between min and max.
//   - Two closed boxes overlap if and only if the lower corner of their intersection, the larger min on every axis, is in both.
//     On every level, the cell of that corner is then among the cells of both boxes; it is the only cell that reports the pair.
//
// Coordinates are not relative to the scene's corner: floats are finest near the origin; subtracting a far corner loses that.
#ifndef BVHBENCH_COLLIDE_HASH_GRID_H
#define BVHBENCH_COLLIDE_HASH_GRID_H

#include "geometry/aabb.h"

SHARED_BEGIN

#define HASH_LEVELS 16u
#define HASH_AXIS_BITS 9u

/// The grid of one frame. 8 bytes.
typedef struct {
    float scale;  // cells of level 0 per unit of length
    uint levels;  // bit L: level L has at least one box
} HashGrid;

/// Range of cells that a box covers, both ends included.
typedef struct {
    int low_x, low_y, low_z, high_x, high_y, high_z;
} CellRange;

/// Cells of `level` per unit of length. The factor is a power of two: exact; where it underflows, the level is a single cell.
SHARED_FN float level_scale(float scale, uint level)
{
    return scale * as_float((127u - 2u * level) << 23u);
}

/// Returns the cell of coordinate x. Clamps as a float, since converting an out-of-range value differs between devices.
SHARED_FN int cell_along(float x, float scale)
{
    const float limit = 1073741824.0f;
    const float at = fmin(fmax(x * scale, -limit), limit);
    const int whole = (int)at;
    return (float)whole > at ? whole - 1 : whole;
}

/// Half the longest side of a box. Halving before subtracting avoids overflow.
SHARED_FN float half_longest(Aabb box)
{
    const float x = 0.5f * box.max_x - 0.5f * box.min_x;
    const float y = 0.5f * box.max_y - 0.5f * box.min_y;
    const float z = 0.5f * box.max_z - 0.5f * box.min_z;
    return fmax(fmax(x, y), z);
}

/// Returns the level of a box. The last level would take all larger boxes; with cells no shorter than the mean side there are
/// none, since a side is at most the sum of all sides and there are fewer than 4^15 triangles.
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

/// Number of a cell. Space wraps around: cells 512 apart along an axis share a number, which two cells of one box never do. So a
/// box has at most one entry per number, and numbers serve as cells: a pair may be tested needlessly, but is reported once.
SHARED_FN uint cell_number(uint level, int x, int y, int z)
{
    const uint mask = (1u << HASH_AXIS_BITS) - 1u;
    return ((((level << HASH_AXIS_BITS) | ((uint)z & mask)) << HASH_AXIS_BITS | ((uint)y & mask))
            << HASH_AXIS_BITS) |
           ((uint)x & mask);
}

SHARED_FN uint level_of_number(uint number) { return number >> 3u * HASH_AXIS_BITS; }

/// Returns the number of the cell that reports two overlapping boxes on `level`.
SHARED_FN uint meeting_number(Aabb a, Aabb b, uint level, float scale)
{
    return cell_number(level, cell_along(fmax(a.min_x, b.min_x), scale),
                       cell_along(fmax(a.min_y, b.min_y), scale),
                       cell_along(fmax(a.min_z, b.min_z), scale));
}

/// Bucket of a cell number, of 2^(32 - shift) buckets: multiplicative hashing by 2^32 over the golden ratio.
SHARED_FN uint bucket_of(uint number, uint shift) { return number * 2654435769u >> shift; }

// An entry of the table: a cell's number and one of its triangles, with the triangle's box, so that a walk along a cell reads
// contiguous memory only. 32 bytes, in kernels two uint4:
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
