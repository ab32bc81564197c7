// SPDX-License-Identifier: MIT
//
// Morton codes: the interleaved bits of a cell's three numbers.
//
//     code = ... x1 y1 z1 x0 y0 z0        10 bits per axis in a uint, 16 or 21 in a ulong
#ifndef BVHBENCH_GEOMETRY_MORTON_H
#define BVHBENCH_GEOMETRY_MORTON_H

#include "geometry/grid.h"

SHARED_BEGIN

#define CELLS_30 1024.0f   // 10 bits per axis: the most that a uint holds
#define CELLS_48 65536.0f  // 16 bits per axis: a sort by bytes takes six passes, for 21 bits eight
#define CELLS_63 2097152.0f  // 21 bits per axis: the most that a ulong holds

/// Returns the low 10 bits of x, with two zeros before each.
SHARED_FN uint spread_10(uint x)
{
    x &= 0x3ffu;
    x = (x | x << 16u) & 0x030000ffu;
    x = (x | x << 8u) & 0x0300f00fu;
    x = (x | x << 4u) & 0x030c30c3u;
    return (x | x << 2u) & 0x09249249u;
}

/// Returns the low 21 bits of x, with two zeros before each.
SHARED_FN ulong spread_21(ulong x)
{
    x &= 0x1ffffful;
    x = (x | x << 32u) & 0x001f00000000fffful;
    x = (x | x << 16u) & 0x001f0000ff0000fful;
    x = (x | x << 8u) & 0x100f00f00f00f00ful;
    x = (x | x << 4u) & 0x10c30c30c30c30c3ul;
    return (x | x << 2u) & 0x1249249249249249ul;
}

/// Returns the Morton code of a cell with 10 bits per axis.
SHARED_FN uint morton_30(GridCell cell)
{
    return spread_10(cell.x) << 2u | spread_10(cell.y) << 1u | spread_10(cell.z);
}

/// Returns the Morton code of a cell with 21 bits per axis.
SHARED_FN ulong morton_63(GridCell cell)
{
    return spread_21(cell.x) << 2u | spread_21(cell.y) << 1u | spread_21(cell.z);
}

/// Returns the Morton code of a cell with 16 bits per axis: the 63-bit code with zeros in its upper bits.
SHARED_FN ulong morton_48(GridCell cell) { return morton_63(cell); }

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(bvhbench::spread_10(0x3ff) == 0x09249249);
static_assert(bvhbench::spread_10(0x201) == 0x08000001);
static_assert(bvhbench::spread_21(0x1fffff) == 0x1249249249249249);
static_assert(bvhbench::spread_21(0x100001) == 0x1000000000000001);
#endif
#endif
