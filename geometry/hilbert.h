// SPDX-License-Identifier: MIT
//
// Hilbert codes: the index of a cell on a curve that visits every cell of a cube, each adjacent to the previous one.
//
// The curve is defined octant by octant, from the largest down. The eight octants of a cube are visited in Gray-code order, so
// consecutive octants share a face. For the curve to leave one octant where it enters the next, the curve inside an octant is
// mirrored or has two axes exchanged. Both operations are applied to the cell instead of the curve [Skilling2004]:
//
//     for each bit, from the highest down to bit 1, for each axis
//         the bit is set      mirror the smaller bits of x
//         it is not           exchange the smaller bits of x and of this axis
//
// The result is one Gray code of three bits per size that includes the turns of all larger sizes. It is decoded, and its bits
// are interleaved like those of a Morton code.
#ifndef BVHBENCH_GEOMETRY_HILBERT_H
#define BVHBENCH_GEOMETRY_HILBERT_H

#include "geometry/morton.h"

SHARED_BEGIN

/// Returns a number whose bit k is the parity of the bits of `x` above k. This decodes a Gray code, shifted down by one bit.
SHARED_FN_INLINED uint parity_above(uint x)
{
    x >>= 1u;
    x ^= x >> 1u;
    x ^= x >> 2u;
    x ^= x >> 4u;
    x ^= x >> 8u;
    return x ^ x >> 16u;
}

/// One step: applies the turn of the octant given by bit `size` of each axis to all lower bits. Without branches, so that many
/// cells can be processed at once.
SHARED_FN_INLINED GridCell hilbert_turned(GridCell cell, uint size)
{
    const uint smaller = (1u << size) - 1u;
    const uint x_set = 0u - (cell.x >> size & 1u), y_set = 0u - (cell.y >> size & 1u);
    const uint z_set = 0u - (cell.z >> size & 1u);
    cell.x ^= x_set & smaller;
    const uint y_flips = (cell.x ^ cell.y) & smaller & ~y_set;
    cell.y ^= y_flips;
    cell.x ^= y_flips | (y_set & smaller);
    const uint z_flips = (cell.x ^ cell.z) & smaller & ~z_set;
    cell.z ^= z_flips;
    cell.x ^= z_flips | (z_set & smaller);
    return cell;
}

/// Decodes the Gray code of each size, after all turns were applied. The Morton code of the result is the Hilbert code.
SHARED_FN_INLINED GridCell hilbert_ungrayed(GridCell cell)
{
    cell.y ^= cell.x;
    cell.z ^= cell.y;
    const uint turns = parity_above(cell.z);
    cell.x ^= turns;
    cell.y ^= turns;
    cell.z ^= turns;
    return cell;
}

/// Returns the cell whose Morton code is the Hilbert code of `cell`, for 1 to 31 `bits` per axis. The curve starts at (0, 0, 0)
/// and ends at the other end of the x axis.
SHARED_FN GridCell hilbert_cell(GridCell cell, uint bits)
{
    for (uint size = bits - 1u; size > 0u; --size)
        cell = hilbert_turned(cell, size);
    return hilbert_ungrayed(cell);
}

/// Returns the Hilbert code of a cell with 10 bits per axis.
SHARED_FN uint hilbert_30(GridCell cell) { return morton_30(hilbert_cell(cell, 10u)); }

/// Returns the Hilbert code of a cell with 16 bits per axis.
SHARED_FN ulong hilbert_48(GridCell cell) { return morton_48(hilbert_cell(cell, 16u)); }

/// Returns the Hilbert code of a cell with 21 bits per axis.
SHARED_FN ulong hilbert_63(GridCell cell) { return morton_63(hilbert_cell(cell, 21u)); }

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(bvhbench::hilbert_30({0, 0, 0}) == 0);
static_assert(bvhbench::hilbert_30({1023, 0, 0}) == 0x3fffffff);
static_assert(bvhbench::hilbert_48({0xffff, 0, 0}) == 0xffffffffffff);
static_assert(bvhbench::hilbert_63({0x1fffff, 0, 0}) == 0x7fffffffffffffff);
#endif
#endif
