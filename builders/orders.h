// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "geometry/scene_bounds.h"

namespace bvhbench {

/// What is put into the order of exact median splits (builders/stages/medians/medians.h).
enum class Medians {
    nowhere,
    in_blocks,   ///< every aligned block of 2^median_block_height leaves, after the sort
    everywhere,  ///< all leaves: nothing to sort, no codes
};

/// What the grid of codes is laid over, where there are several objects.
enum class GridOver {
    object,  ///< each object, a grid of its own
    scene,   ///< all objects together
};

/// A way to line up leaves: a code a box, sorted ascending, ties in the triangles' own order; then medians.
struct OrderEntry {
    std::string_view name;     ///< "morton30": the key on the command line and in result files
    std::string_view summary;  ///< one line for `list orders`
    unsigned code_bits;        ///< only these bits are sorted; over 32, codes take 64; 0: no codes
    bool is_hilbert = false,
         is_stretched = false;  ///< of codes: the curve, and the grid (geometry/grid.h)
    Medians medians = Medians::nowhere;

    /// The code on the host: of a leaf's box, given the bounds of all boxes and of their centres. As builders/stages/code_of.clh.
    ulong code(Aabb box, Bounds bounds) const;
};

/// Every order, in the order tables list them. To add one: docs/adding.md.
std::span<const OrderEntry> order_catalog();

/// By name. Throws BadUsage with the known names when there is none.
const OrderEntry& find_order(std::string_view name);

}  // namespace bvhbench
