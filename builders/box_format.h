// SPDX-License-Identifier: MIT
//
// Storage formats of trees' boxes, and their rounding on the host. The rounding itself is in geometry/box_cells.h.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "geometry/aabb.h"
#include "geometry/box_cells.h"

namespace bvhbench {

/// One box format, as `list formats` prints it.
struct BoxFormat {
    std::string_view name;  ///< Unique key on the command line and in result files, such as "u16".
    std::string_view summary;  ///< One-line description.
    uint number;               ///< Value of BOX_FORMAT in kernels.
    std::size_t side_bytes;

    std::size_t box_bytes() const { return 6 * side_bytes; }
    bool has_cells() const { return last_cell(number) > 0; }  ///< If false, boxes are exact.
};

/// All formats, floats first. docs/adding.md says how to add one.
std::span<const BoxFormat> box_formats();

/// Default format.
inline const BoxFormat& float_boxes() { return box_formats().front(); }

/// Returns the format called `name`. Throws BadUsage with the known names if there is none.
const BoxFormat& find_box_format(std::string_view name);

/// Conversion of a scene's boxes to a format and back.
struct BoxRounding {
    const BoxFormat* format = &float_boxes();
    SceneCells cells = {};  ///< Used by formats with cells only.

    /// Returns the conversion for the scene with bounds `scene`, with the same cells as the device computes.
    static BoxRounding of_scene(const BoxFormat& format, const Aabb& scene);

    /// Returns the six sides of `box` as kernels store them.
    std::vector<std::byte> stored(const Aabb& box) const;

    /// Returns the smallest float box that contains the stored box; a side beyond the largest float is infinite. Where
    /// adjacent floats are further apart than cells, that box is larger: queries compare stored boxes, not these.
    Aabb read(std::span<const std::byte> stored) const;

    /// Returns `box` after storing and reading it: a box that contains `box`, and equals it in exact formats.
    Aabb operator()(const Aabb& box) const { return read(stored(box)); }
};

/// Returns `count` empty boxes as kernels store them.
std::vector<std::byte> stored_empty_boxes(const BoxFormat& format, std::size_t count);

}  // namespace bvhbench
