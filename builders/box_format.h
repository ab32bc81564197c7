// SPDX-License-Identifier: MIT
//
// The formats that trees may keep their boxes in: geometry/box_cells.h for the host.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "geometry/aabb.h"
#include "geometry/box_cells.h"

namespace bvhbench {

/// A line of `list formats`.
struct BoxFormat {
    std::string_view name;     ///< "u16": the key on the command line and in result files
    std::string_view summary;  ///< one line
    uint number;               ///< BOX_FORMAT of kernels
    std::size_t side_bytes;

    std::size_t box_bytes() const { return 6 * side_bytes; }
    bool has_cells() const { return last_cell(number) > 0; }  ///< if not, boxes are exact
};

/// Every format, floats first. To add one: docs/adding.md.
std::span<const BoxFormat> box_formats();

/// The format of trees that say nothing else.
inline const BoxFormat& float_boxes() { return box_formats().front(); }

/// By name. Throws BadUsage with the known names when there is none.
const BoxFormat& find_box_format(std::string_view name);

/// What a format makes of the boxes of a scene.
struct BoxRounding {
    const BoxFormat* format = &float_boxes();
    SceneCells cells = {};  ///< of formats that have them

    /// Of the scene whose boxes fill `scene` together, as the device finds it.
    static BoxRounding of_scene(const BoxFormat& format, const Aabb& scene);

    /// A box's six sides as kernels keep them.
    std::vector<std::byte> stored(const Aabb& box) const;

    /// The smallest box of floats around a stored one: infinite where it ends beyond them.
    Aabb read(std::span<const std::byte> stored) const;

    /// What is read back of what is stored: it contains `box`, and is no other for exact formats.
    Aabb operator()(const Aabb& box) const { return read(stored(box)); }
};

/// So many boxes that contain nothing, as kernels keep them.
std::vector<std::byte> stored_empty_boxes(const BoxFormat& format, std::size_t count);

}  // namespace bvhbench
