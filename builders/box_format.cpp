// SPDX-License-Identifier: MIT
#include "builders/box_format.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "geometry/names.h"

namespace bvhbench {
namespace {

// To add a format, add its line here, its number and type in geometry/box_side.h and its rounding in geometry/box_cells.h.
constexpr BoxFormat formats[] = {
    {"f32", "floats, as boxes are made", BOX_F32, 4},
    {"f64", "doubles: the same boxes in twice the bytes", BOX_F64, 8},
    {"f16", "halves from the middle of the scene, rounded outward", BOX_F16, 2},
    {"u16", "65,534 cells along each axis of the scene, rounded outward", BOX_U16, 2},
    {"u8", "254 cells along each axis of the scene, rounded outward", BOX_U8, 1},
};

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Returns the outer bound of a cell: for a lower side, the largest float not above the cell; for an upper side, the smallest
/// float not below it.
float end_of_cell(const AxisCells& cells, double cell, bool is_upper)
{
    // The product is exact and decides; the rounded quotient is off by a step or two at most. The sum is exact up to 2^53.
    // Beyond that the scene is so far from the origin that the difference is exact.
    const float outward = is_upper ? infinity : -infinity;
    const double sum = cell + cells.first;
    const bool is_far = std::abs(cells.first) >= 0x1p52;
    const auto is_outside = [&](float x) {
        const double product = static_cast<double>(x) * cells.scale;
        const double difference = is_far ? (product - cells.first) - cell : product - sum;
        return is_upper ? difference >= 0 : difference <= 0;
    };
    auto end = static_cast<float>(sum / cells.scale);
    while (!is_outside(end))
        end = std::nextafter(end, outward);
    for (float next = std::nextafter(end, -outward); is_outside(next);
         next = std::nextafter(end, -outward))
        end = next;
    return end + 0.0f;  // no -0
}

template <class Side>
Side side_at(std::span<const std::byte> stored, std::size_t which)
{
    Side side;
    std::memcpy(&side, stored.data() + which * sizeof side, sizeof side);
    return side;
}

template <class Side>
void put(std::vector<std::byte>& stored, Side side)
{
    const auto bytes = std::as_bytes(std::span(&side, 1));
    stored.insert(stored.end(), bytes.begin(), bytes.end());
}

/// Appends a side as it is stored; in formats with cells `side` is the cell's number.
void put_side(std::vector<std::byte>& stored, const BoxFormat& format, double side)
{
    switch (format.number) {
        case BOX_F32:
            return put(stored, static_cast<float>(side));
        case BOX_F64:
            return put(stored, side);
        case BOX_U8:
            return put(stored, static_cast<std::uint8_t>(side));
        default:
            return put(stored, static_cast<std::uint16_t>(side));
    }
}

uint number_at(const BoxFormat& format, std::span<const std::byte> stored, std::size_t which)
{
    return format.side_bytes == 1 ? side_at<std::uint8_t>(stored, which)
                                  : side_at<std::uint16_t>(stored, which);
}

}  // namespace

std::span<const BoxFormat> box_formats() { return formats; }

const BoxFormat& find_box_format(std::string_view name)
{
    return find_called(formats, name, "format of boxes");
}

BoxRounding BoxRounding::of_scene(const BoxFormat& format, const Aabb& scene)
{
    if (!format.has_cells())
        return {&format};
    const double last = last_cell(format.number);
    return {&format,
            {axis_cells(scene.min_x, scene.max_x, last), axis_cells(scene.min_y, scene.max_y, last),
             axis_cells(scene.min_z, scene.max_z, last)}};
}

std::vector<std::byte> BoxRounding::stored(const Aabb& box) const
{
    const std::array sides = {box.min_x, box.min_y, box.min_z, box.max_x, box.max_y, box.max_z};
    const std::array axes = {cells.x, cells.y, cells.z};
    std::vector<std::byte> result;
    for (std::size_t k = 0; k < sides.size(); ++k)
        put_side(result, *format,
                 format->has_cells() ? side_in(format->number, axes[k % 3], sides[k], k >= 3)
                                     : double{sides[k]});
    return result;
}

Aabb BoxRounding::read(std::span<const std::byte> stored) const
{
    assert(stored.size() == format->box_bytes());
    const std::array axes = {cells.x, cells.y, cells.z};
    std::array<float, 6> sides;
    for (std::size_t k = 0; k < sides.size(); ++k) {
        if (format->has_cells())
            sides[k] = end_of_cell(
                axes[k % 3], cell_of_side(format->number, number_at(*format, stored, k)), k >= 3);
        else if (format->number == BOX_F64)
            sides[k] = static_cast<float>(side_at<double>(stored, k));
        else
            sides[k] = side_at<float>(stored, k);
    }
    return {sides[0], sides[1], sides[2], sides[3], sides[4], sides[5]};
}

std::vector<std::byte> stored_empty_boxes(const BoxFormat& format, std::size_t count)
{
    const Aabb none = empty_box();
    const double most = format.number == BOX_F64   ? std::numeric_limits<double>::max()
                        : format.number == BOX_F32 ? double{none.min_x}
                        : format.number == BOX_U8  ? 255.0
                                                   : 65535.0;
    const double least = format.has_cells() ? 0.0 : -most;
    std::vector<std::byte> one;
    for (std::size_t k = 0; k < 6; ++k)
        put_side(one, format, k < 3 ? most : least);
    std::vector<std::byte> all;
    all.reserve(count * one.size());
    for (std::size_t k = 0; k < count; ++k)
        all.insert(all.end(), one.begin(), one.end());
    return all;
}

}  // namespace bvhbench
