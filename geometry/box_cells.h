// SPDX-License-Identifier: MIT
//
// Conversion of float coordinates to box sides in other formats, rounded outward: lower sides down, upper sides up.
//
// Each axis of the scene's bounds is divided into cells, and a coordinate becomes the number of its cell:
//
//     floor(x * scale) - first     for a lower side, ceil for an upper side
//
// `scale` has 8 significant bits, so its product with a float is exact in a double. floor, ceil and the subtraction are exact:
// `first` is a whole number too, the scene's lower end rounded down. The only rounding is therefore the intended one: cells
// keep the order of coordinates, a lower side's cell is never above its coordinate, and an upper side's is never below it.
// Boxes that overlap as floats overlap as cells, and an inner node's box is the union of its children's boxes in both
// representations.
//
//     u8, u16     254 and 65,534 cells; the cell number is the side
//     f16         one cell per smallest half, from the most negative half to the largest; the cell number, counted from
//                 the middle, is rounded outward again, to eleven bits, and stored as its index among all halves
//     f64         no cells: every float is a double
//
// [Ylitie2017] rounds the boxes of each node outward on a grid of that node; here one grid covers the whole scene.
#ifndef BVHBENCH_GEOMETRY_BOX_CELLS_H
#define BVHBENCH_GEOMETRY_BOX_CELLS_H

#include "geometry/box_side.h"

#if HAS_DOUBLES

SHARED_BEGIN

/// Cells along one axis. 16 bytes.
typedef struct {
    double scale;  ///< cells per unit of length
    double first;  ///< number of the scene's lower end, subtracted from all cell numbers
} AxisCells;

/// Cells along all three axes. 48 bytes.
typedef struct {
    AxisCells x, y, z;
} SceneCells;

/// Number of cells from the middle to the largest half: 65504 in units of the smallest half.
#define HALF_CELLS 1098974756864.0  // 2047 * 2^29

/// Returns the number of the last cell along an axis; 0 for formats without cells.
SHARED_FN_INLINED double last_cell(uint format)
{
    return format == BOX_U8    ? 254.0
           : format == BOX_U16 ? 65534.0
           : format == BOX_F16 ? 2.0 * HALF_CELLS
                               : 0.0;
}

/// Returns the whole number nearest to `x`, which has at most 32 significant bits: beyond 2^51 it is whole. Used in place of
/// floor and ceil, which are function calls on PoCL and made gathering the leaves several times slower.
SHARED_FN_INLINED double whole_near(double x)
{
    const double shift =
        6755399441055744.0;  // 1.5 * 2^52: a double of this size has no fractional bits
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

/// Returns `x`, which is positive, with all but its 8 leading significant bits cleared.
SHARED_FN double eight_bits_of(double x) { return as_double(as_ulong(x) & 0xffffe00000000000ul); }

/// Returns the cells 0 to `last` along an axis on which the scene extends between two finite floats. The cells reach beyond
/// both ends by at most one cell, and their width is within one part in 128 of the smallest possible.
SHARED_FN AxisCells axis_cells(float low, float high, double last)
{
    AxisCells cells;
    const double length = (double)high - (double)low;
    cells.scale = length > 0.0 ? eight_bits_of((last - 2.0) / length) : 1.0;
    cells.first = whole_below((double)low * cells.scale);
    return cells;
}

/// Returns the cell number of a lower or an upper side, clamped to 0 and `last` outside the scene.
SHARED_FN_INLINED double cell_of(AxisCells cells, float x, bool is_upper, double last)
{
    const double product = (double)x * cells.scale;
    const double cell = (is_upper ? whole_above(product) : whole_below(product)) - cells.first;
    return cell < 0.0 ? 0.0 : cell > last ? last : cell;
}

/// Returns the bits of the largest half not above `size`, a whole number of smallest halves, at most HALF_CELLS.
SHARED_FN_INLINED uint half_below(double size)
{
    if (size < 2048.0)
        return (uint)size;
    const ulong bits = as_ulong(size);
    return (uint)(bits >> 42u) - ((1023u + 9u) << 10u);
}

/// Returns the bits of the smallest half not below `size`.
SHARED_FN_INLINED uint half_above(double size)
{
    const uint below = half_below(size);
    return size < 2048.0 || (as_ulong(size) & 0x3fffffffffful) == 0ul ? below : below + 1u;
}

/// Rounds a cell number outward to a half and returns the index of that half among all halves; 0 has index 32768.
SHARED_FN_INLINED uint half_of_cell(double cell, bool is_upper)
{
    const double size = cell - HALF_CELLS;
    if (size >= 0.0)
        return 0x8000u + (is_upper ? half_above(size) : half_below(size));
    return 0x8000u - (is_upper ? half_below(-size) : half_above(-size));
}

/// Returns the side of a box for a coordinate, in a format with cells.
SHARED_FN_INLINED uint side_in(uint format, AxisCells cells, float x, bool is_upper)
{
    const double cell = cell_of(cells, x, is_upper, last_cell(format));
    return format == BOX_F16 ? half_of_cell(cell, is_upper) : (uint)cell;
}

/// Returns the cell number of a side, in a format with cells.
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
