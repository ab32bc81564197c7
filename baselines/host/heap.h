// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>

namespace bvhbench {

/// How many of `leaves` leaves, two or more, lie under the left child of a left-balanced tree: every level
/// full but the last, and the last filled from the left. Numbered level by level such a tree has no gaps.
///
///     5 leaves              0
///                     1           2         left: 3, right: 2
///                  3     4     5     6
///                 7 8
constexpr std::size_t heap_left_leaves(std::size_t leaves)
{
    const std::size_t full = std::bit_floor(leaves);  // leaves of the tree without its last level
    return std::min(full, leaves - full / 2);
}

static_assert(heap_left_leaves(2) == 1);
static_assert(heap_left_leaves(3) == 2);
static_assert(heap_left_leaves(4) == 2);
static_assert(heap_left_leaves(5) == 3);
static_assert(heap_left_leaves(6) == 4);
static_assert(heap_left_leaves(7) == 4);

}  // namespace bvhbench
