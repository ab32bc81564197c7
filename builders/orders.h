// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "geometry/scene_bounds.h"

namespace bvhbench {

/// Which leaves are put into the order of exact median splits (builders/stages/medians/medians.h).
enum class Medians {
    nowhere,
    in_blocks,   ///< Every aligned block of 2^median_block_height leaves, after the sort.
    everywhere,  ///< All leaves; there are no codes and no sort.
};

/// Bounds that the grid of the codes divides, if there are several objects.
enum class GridOver {
    object,  ///< Each object has its own grid.
    scene,   ///< One grid over all objects.
};

/// An order of the leaves: ascending by a code per box, ties by triangle id; then medians, if any.
struct OrderEntry {
    std::string_view name;     ///< Key on the command line and in result files, such as "morton30".
    std::string_view summary;  ///< One line for `list orders`.
    unsigned code_bits;  ///< Bits that are sorted by; above 32, a code has 64 bits. 0: no codes.
    bool is_hilbert = false,
         is_stretched = false;  ///< The curve, and whether cells are stretched (geometry/grid.h).
    Medians medians = Medians::nowhere;

    /// Returns the code of a leaf box, given the bounds of all boxes and of their centres: code_of.clh on the host.
    ulong code(Aabb box, Bounds bounds) const;
};

/// All orders, as listed in tables. docs/adding.md says how to add one.
std::span<const OrderEntry> order_catalog();

/// Returns the order called `name`. Throws BadUsage with the known names if there is none.
const OrderEntry& find_order(std::string_view name);

}  // namespace bvhbench
