// SPDX-License-Identifier: MIT
//
// From floats to the sides of boxes in other formats, rounded outward: lower sides down, upper ones up.
//
// A scene's bounds are cut into cells along each axis, and a coordinate becomes the number of its cell:
//
//     floor(x * scale) - first     of a lower side, ceil of an upper one
//
// `scale` has 8 bits that count, so that its product with a float is exact in a double; floor and ceil are, and `first`,
// the scene's lower end, is rounded to such a number too. So nothing is rounded but what is meant to be:
// cells keep the order of coordinates, a lower side's is never above its coordinate and an upper one's never below it.
// What overlaps as floats overlaps as cells, and an inner node's box is the union of its children's in either.
//
//     u8, u16     254 and 65,534 cells: the number is the side
//     f16         as many as there are smallest halves from the most negative one to the largest; the number, counted
//                 from the middle, is rounded once more, outward, to eleven bits, and stored as its place among all halves
//     f64         no cells: a float is a double
//
// [Ylitie2017] rounds the boxes of a node outward on a grid of its own; here one grid serves a scene.
#ifndef BVHBENCH_GEOMETRY_BOX_CELLS_H
#define BVHBENCH_GEOMETRY_BOX_CELLS_H

#include "geometry/box_side.h"

#if HAS_DOUBLES

SHARED_BEGIN

/// The cells along one axis. 16 bytes.
typedef struct {
    double scale;  ///< cells a unit of length
    double first;  ///< the lower end's, before it is number 0
} AxisCells;

/// Of all axes. 48 bytes.
typedef struct {
    AxisCells x, y, z;
} SceneCells;

/// Cells from the middle to the largest half, 65504, in units of the smallest.
#define HALF_CELLS 1098974756864.0  // 2047 * 2^29

/// The number of the last cell along an axis; 0 of formats without cells.
SHARED_FN_INLINED double last_cell(uint format)
{
    return format == BOX_U8    ? 254.0
           : format == BOX_U16 ? 65534.0
           : format == BOX_F16 ? 2.0 * HALF_CELLS
                               : 0.0;
}

/// The whole number nearest to `x`, whose bits are 32 at most: beyond 2^51 it is one. Where floor and ceil are a call, as
/// PoCL's are, lining leaves up took several times as long with them.
SHARED_FN_INLINED double whole_near(double x)
{
    const double shift =
        6755399441055744.0;  // 1.5 * 2^52: a double of that size has no bits after the point
    return fabs(x) < 2251799813685248.0 ? (x + shift) - shift : x;
}

SHARED_FN_INLINED double whole_below(double x)
{
    const double near = whole_near(x);
    return near > x ? near - 1.0 : near;
}

SHARED_FN_INLINED double whole_above(double x)
{
    const double near = whole_near(x);
    return near < x ? near + 1.0 : near;
}

/// `x`, positive, without all but the first 8 of its bits.
SHARED_FN double eight_bits_of(double x) { return as_double(as_ulong(x) & 0xffffe00000000000ul); }

/// The cells, 0 to `last`, along an axis on which a scene is between two finite floats. They reach beyond both ends by one
/// at most, and are the smallest such, but for a part in 128.
SHARED_FN AxisCells axis_cells(float low, float high, double last)
{
    AxisCells cells;
    const double length = (double)high - (double)low;
    cells.scale = length > 0.0 ? eight_bits_of((last - 2.0) / length) : 1.0;
    cells.first = whole_below((double)low * cells.scale);
    return cells;
}

/// The number of the cell of a lower or an upper side; what is outside the scene is in its last cell.
SHARED_FN_INLINED double cell_of(AxisCells cells, float x, bool is_upper, double last)
{
    const double product = (double)x * cells.scale;
    const double cell = (is_upper ? whole_above(product) : whole_below(product)) - cells.first;
    return cell < 0.0 ? 0.0 : cell > last ? last : cell;
}

/// The largest half not above `size`, a whole number of smallest halves up to HALF_CELLS, as its bits.
SHARED_FN_INLINED uint half_below(double size)
{
    if (size < 2048.0)
        return (uint)size;
    const ulong bits = as_ulong(size);
    return (uint)(bits >> 42u) - ((1023u + 9u) << 10u);
}

/// The smallest half not below it.
SHARED_FN_INLINED uint half_above(double size)
{
    const uint below = half_below(size);
    return size < 2048.0 || (as_ulong(size) & 0x3fffffffffful) == 0ul ? below : below + 1u;
}

/// The half that a cell's number is rounded to, as its place among all halves, 0 being at 32768.
SHARED_FN_INLINED uint half_of_cell(double cell, bool is_upper)
{
    const double size = cell - HALF_CELLS;
    if (size >= 0.0)
        return 0x8000u + (is_upper ? half_above(size) : half_below(size));
    return 0x8000u - (is_upper ? half_below(-size) : half_above(-size));
}

/// A side of a box in a format with cells.
SHARED_FN_INLINED uint side_in(uint format, AxisCells cells, float x, bool is_upper)
{
    const double cell = cell_of(cells, x, is_upper, last_cell(format));
    return format == BOX_F16 ? half_of_cell(cell, is_upper) : (uint)cell;
}

/// The number of the cell that a side is, of a format with cells.
SHARED_FN double cell_of_side(uint format, uint side)
{
    if (format != BOX_F16)
        return (double)side;
    const uint bits = side < 0x8000u ? 0x8000u - side : side - 0x8000u;
    const uint exponent = bits >> 10u;
    const double size = exponent == 0u ? (double)bits
                                       : (double)((bits & 0x3ffu) + 0x400u) *
                                             as_double((ulong)(exponent - 1u + 1023u) << 52u);
    return side < 0x8000u ? HALF_CELLS - size : HALF_CELLS + size;
}

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(bvhbench::SceneCells) == 48);
static_assert(bvhbench::half_below(HALF_CELLS) == 0x7bff &&
              bvhbench::half_above(HALF_CELLS) == 0x7bff);
static_assert(bvhbench::half_below(2048.0) == 0x800 && bvhbench::half_above(2049.0) == 0x801);
#endif
#endif
#endif
