// SPDX-License-Identifier: MIT
//
// Appendix C for a power-of-two arity k = 2^bits: kary_layout.h without loops or divisions by a variable, for kernels that
// evaluate it at every node. Its levels are every bits-th level of the binary tree, counted from the leaves.
//
// A node is named by its label: a leading 1, followed by the position on its level with `bits` bits per level, so that the
// labels of its ancestors are its leading bits:
//
//     label = 1 ppp ppp ... ppp       k = 8
//
// Only inner nodes are stored, level by level from the left, each with the boxes of its children. A single leaf has an inner
// node above it, too, which holds its box. Valid for up to kary_most_leaves(k) leaves, 2^30 for k = 4 and 8.
#ifndef BVHBENCH_OIBVH_WIDE_LAYOUT_H
#define BVHBENCH_OIBVH_WIDE_LAYOUT_H

#include "geometry/bits.h"

SHARED_BEGIN

/// Returns the level of the leaves, at least 1; the root is level 0.
SHARED_FN uint wide_leaf_level(uint leaves, uint bits)
{
    return leaves <= 1u ? 1u : divided_up(ceil_log2(leaves), bits);
}

/// Returns the real nodes on a level.
SHARED_FN uint wide_real_on(uint leaves, uint bits, uint level)
{
    return ((leaves - 1u) >> (bits * (wide_leaf_level(leaves, bits) - level))) + 1u;
}

/// Returns the sum of the digits of `number` to the base k, for bits = 2 or 3: each set bit counts with its weight within its
/// digit.
SHARED_FN uint wide_digit_sum(uint bits, uint number)
{
    return bits == 2u ? popcount(number) + popcount(number & 0xaaaaaaaau)
                      : popcount(number) + popcount(number & 0x92492492u) +
                            3u * popcount(number & 0x24924924u);
}

/// Returns the slot of the leftmost node of a level; equals kary_first_slot.
SHARED_FN uint wide_first_slot(uint leaves, uint bits, uint level)
{
    const uint leaf_level = wide_leaf_level(leaves, bits);
    const uint virtual_leaves = (1u << (bits * leaf_level)) - leaves;
    const uint above = virtual_leaves >> (bits * (leaf_level - level)) >> bits;
    const uint first = (bits == 2u ? 0x55555555u : 0x49249249u) & ((1u << (bits * level)) - 1u);
    return first - above - (above - wide_digit_sum(bits, above)) / ((1u << bits) - 1u);
}

/// Returns the number of inner nodes, which are all that is stored.
SHARED_FN uint wide_inner_count(uint leaves, uint bits)
{
    return wide_first_slot(leaves, bits, wide_leaf_level(leaves, bits));
}

SHARED_END

#ifndef __OPENCL_C_VERSION__
namespace bvhbench {
static_assert(wide_inner_count(1, 3) == 1 && wide_inner_count(8, 3) == 1 &&
              wide_inner_count(9, 3) == 3);
static_assert(wide_inner_count(2880000, 3) == 411431);  // a seventh of the triangles
}  // namespace bvhbench
#endif
#endif
