// SPDX-License-Identifier: MIT
//
// Hilbert codes: the number of a cell on a curve that visits every cell of a cube, each next to the last.
//
// Octant by octant, from the largest down. The eight octants of a cube are visited in Gray-code order, so
// that neighbours on the curve share a face. For the curve to leave one octant where it enters the next,
// the curve inside an octant is mirrored or has two axes exchanged. Both are done to the cell instead of to
// the curve [Skilling2004]:
//
//     for each bit, from the second largest size down, for each axis
//         the bit is set      mirror the smaller bits of x
//         it is not           exchange the smaller bits of x and of this axis
//
// What is left is one Gray code of three bits a size, with the turns of all larger sizes in it; undone, the
// bits are interleaved as a Morton code's are.
#ifndef BVHBENCH_GEOMETRY_HILBERT_H
#define BVHBENCH_GEOMETRY_HILBERT_H

#include "geometry/morton.h"

SHARED_BEGIN

/// `a` and `b` with the bits of `mask` exchanged where `set` is 0; with those of `a` mirrored where it is not.
/// Returned as the word to flip in `a`; `b` flips it only when exchanged.
SHARED_FN uint hilbert_flips(uint a, uint b, uint set, uint mask)
{
    return (set != 0u ? 0xffffffffu : a ^ b) & mask;
}

/// Bit k of the result is the parity of the bits of x above k: what turns a Gray code back into a number,
/// shifted down by one.
SHARED_FN uint parity_above(uint x)
{
    x >>= 1u;
    x ^= x >> 1u;
    x ^= x >> 2u;
    x ^= x >> 4u;
    x ^= x >> 8u;
    return x ^ x >> 16u;
}

/// The cell whose Morton code is the Hilbert code of `cell`, for `bits` bits an axis, 1 to 31.
/// The curve starts at (0, 0, 0) and ends at the other end of the x axis.
SHARED_FN Cell hilbert_cell(Cell cell, uint bits)
{
    for (uint bit = 1u << (bits - 1u); bit > 1u; bit >>= 1u) {
        const uint smaller = bit - 1u;
        cell.x ^= hilbert_flips(cell.x, cell.x, cell.x & bit, smaller);
        const uint y_flips = hilbert_flips(cell.x, cell.y, cell.y & bit, smaller);
        cell.y ^= (cell.y & bit) != 0u ? 0u : y_flips;
        cell.x ^= y_flips;
        const uint z_flips = hilbert_flips(cell.x, cell.z, cell.z & bit, smaller);
        cell.z ^= (cell.z & bit) != 0u ? 0u : z_flips;
        cell.x ^= z_flips;
    }
    cell.y ^= cell.x;
    cell.z ^= cell.y;
    const uint turns = parity_above(cell.z);
    cell.x ^= turns;
    cell.y ^= turns;
    cell.z ^= turns;
    return cell;
}

/// The code of a cell of 10 bits an axis.
SHARED_FN uint hilbert_30(Cell cell) { return morton_30(hilbert_cell(cell, 10u)); }

/// The code of a cell of 21 bits an axis.
SHARED_FN ulong hilbert_63(Cell cell) { return morton_63(hilbert_cell(cell, 21u)); }

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(bvhbench::hilbert_30({0, 0, 0}) == 0);
static_assert(bvhbench::hilbert_30({1023, 0, 0}) == 0x3fffffff);
static_assert(bvhbench::hilbert_63({0x1fffff, 0, 0}) == 0x7fffffffffffffff);
#endif
#endif
