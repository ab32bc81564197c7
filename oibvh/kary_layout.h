// SPDX-License-Identifier: MIT
//
// Appendix C: the ostensibly-implicit layout with k children per node, for host and device.
//
// For k = 2 it is the layout of layout.h. Real nodes fill each level from the left, virtual nodes are never stored, and a node
// is virtual if all its children are.
//
//     k = 3, t = 5                  0                         level 0
//                       1           2         (3)             level 1     1 virtual
//                     4 5 6      7 8 (9)  (10 11 12)          level 2     4 virtual = L_v
//
// Stored order:   0 | 1 2 | 4 5 6 7 8         8 slots
//
// The paper's Eq. (17) and (18) do not describe this tree. The correct formulas are derived at each function, and
// tests/oibvh/errata_test.cpp shows where the printed ones fail.
//
// Valid while the nodes of the perfect tree can be counted in 32 bits: up to kary_most_leaves(k) leaves.
#ifndef BVHBENCH_OIBVH_KARY_LAYOUT_H
#define BVHBENCH_OIBVH_KARY_LAYOUT_H

#include "geometry/bits.h"

SHARED_BEGIN

/// Shape of a tree, determined by the numbers of leaves and of children per node.
typedef struct {
    uint leaves;          ///< t, at least 1 and at most kary_most_leaves(arity)
    uint arity;           ///< Children per node, at least 2: the paper's kappa.
    uint virtual_leaves;  ///< L_v = k^ceil(log_k t) - t, Eq. (1) to the base k
    uint leaf_level;      ///< ceil(log_k t); the root is level 0
} KaryShape;

/// Returns k^n, which must fit in 32 bits.
SHARED_FN uint kary_power(uint arity, uint n)
{
    uint power = 1u;
    for (uint step = 0u; step < n; ++step)
        power *= arity;
    return power;
}

/// Returns the implicit index of the leftmost node on a level, which is also the number of nodes above that level: 1 + k + ...
/// + k^(level - 1) = (k^level - 1) / (k - 1), summed so that no larger number is formed.
SHARED_FN uint kary_first(uint arity, uint level)
{
    uint first = 0u;
    for (uint step = 0u; step < level; ++step)
        first = first * arity + 1u;
    return first;
}

/// Returns the most leaves whose implicit indices fit in 32 bits, a power of k: 2^31 for k = 2, 3^19 for 3, 4^15 for 4, 8^10
/// for 8.
SHARED_FN uint kary_most_leaves(uint arity)
{
    // A tree of n nodes with one more level has k n + 1.
    const uint largest = 0xffffffffu;
    uint nodes = 1u;
    uint leaves = 1u;
    while (nodes <= (largest - 1u) / arity) {
        nodes = nodes * arity + 1u;
        leaves *= arity;
    }
    return leaves;
}

SHARED_FN KaryShape kary_shape(uint leaves, uint arity)
{
    KaryShape shape;
    shape.leaves = leaves;
    shape.arity = arity;
    shape.leaf_level = 0u;
    uint width = 1u;
    while (width < leaves) {
        width *= arity;
        ++shape.leaf_level;
    }
    shape.virtual_leaves = width - leaves;
    return shape;
}

/// Returns the number of nodes of the perfect tree over the same leaves: Eq. (2) to the base k.
SHARED_FN uint kary_perfect_node_count(KaryShape shape)
{
    return kary_first(shape.arity, shape.leaf_level + 1u);
}

/// Returns the level of implicit index i.
SHARED_FN uint kary_level(KaryShape shape, uint i)
{
    uint level = 0u;
    for (uint width = 1u; i >= width; width *= shape.arity) {
        i -= width;
        ++level;
    }
    return level;
}

/// Returns L_vl, the virtual nodes on a level: floor(L_v / k^(leaf_level - level)).
///
/// Eq. (18) prints the exponent l - 1, which counts L_v nodes on level 1. One level up, each k virtual siblings have one
/// virtual parent and a remainder has none, so the exponent is the distance from the leaves, as in Eq. (8).
SHARED_FN uint kary_virtual_on(KaryShape shape, uint level)
{
    return shape.virtual_leaves / kary_power(shape.arity, shape.leaf_level - level);
}

/// Returns the real nodes on a level.
SHARED_FN uint kary_real_on(KaryShape shape, uint level)
{
    return kary_power(shape.arity, level) - kary_virtual_on(shape, level);
}

/// Returns the sum of the digits of `number` to the base k: the number of set bits if k = 2.
SHARED_FN uint kary_digit_sum(uint arity, uint number)
{
    uint sum = 0u;
    for (; number != 0u; number /= arity)
        sum += number % arity;
    return sum;
}

/// Returns the virtual nodes on a level and all levels above it, given that level's virtual count v: Eq. (10), (17).
///
/// To the base k, v = sum of d_y k^y. Each digit d_y contributes d_y perfect trees with k^y leaves and (k^(y+1) - 1) / (k - 1)
/// nodes each. Their sum is (k v - digit_sum(v)) / (k - 1) = floor(v / 1) + floor(v / k) + floor(v / k^2) + ... Eq. (17) prints
/// the exponent y, one too small, and for k > 2 its set of powers must be read as a list, because a digit may be larger than 1.
/// The code avoids k v, which may not fit in 32 bits.
SHARED_FN uint kary_virtual_up_to(uint arity, uint virtual_on_level)
{
    return virtual_on_level +
           (virtual_on_level - kary_digit_sum(arity, virtual_on_level)) / (arity - 1u);
}

/// Returns N_v, the virtual nodes of the whole tree: Eq. (17), corrected.
SHARED_FN uint kary_virtual_node_count(KaryShape shape)
{
    return kary_virtual_up_to(shape.arity, shape.virtual_leaves);
}

/// Returns N_r, the number of stored nodes: Eq. (3).
SHARED_FN uint kary_node_count(KaryShape shape)
{
    return kary_perfect_node_count(shape) - kary_virtual_node_count(shape);
}

SHARED_FN bool kary_is_real(KaryShape shape, uint i)
{
    const uint level = kary_level(shape, i);
    return i - kary_first(shape.arity, level) < kary_real_on(shape, level);
}

/// Returns the slot of the leftmost node on a level. The nodes of a level are contiguous.
SHARED_FN uint kary_first_slot(KaryShape shape, uint level)
{
    // The level above has floor(L_vl / k) virtual nodes, and at the root this is 0, so no level is a special case.
    const uint virtual_above = kary_virtual_on(shape, level) / shape.arity;
    return kary_first(shape.arity, level) - kary_virtual_up_to(shape.arity, virtual_above);
}

/// Returns i_m, the slot of node i: Eq. (9).
SHARED_FN uint kary_slot(KaryShape shape, uint i)
{
    const uint level = kary_level(shape, i);
    return kary_first_slot(shape, level) + (i - kary_first(shape.arity, level));
}

/// child(i, j) for 1 <= j <= k, and parent(i): App. A to the base k.
SHARED_FN uint kary_child(uint arity, uint i, uint j) { return arity * i + j; }
SHARED_FN uint kary_parent(uint arity, uint i) { return (i - 1u) / arity; }

/// Returns the m-th descendant of i, n levels down, 0 <= m < k^n: Eq. (12) to the base k.
SHARED_FN uint kary_descendant(uint arity, uint i, uint n, uint m)
{
    return kary_power(arity, n) * i + kary_first(arity, n) + m;
}

/// Returns the ancestor of j, n levels up: Eq. (13) to the base k. The division drops m, which is not needed.
SHARED_FN uint kary_ancestor(uint arity, uint j, uint n)
{
    return (j - kary_first(arity, n)) / kary_power(arity, n);
}

SHARED_END

#ifndef __OPENCL_C_VERSION__
namespace bvhbench {
static_assert(sizeof(KaryShape) == 16);
static_assert(kary_node_count(kary_shape(5, 3)) == 8);  // the drawing above
static_assert(kary_slot(kary_shape(5, 3), 4) == 3);     // node 4 follows node 2: node 3 is virtual
static_assert(kary_node_count(kary_shape(144046, 2)) == 288100);  // Table 1
static_assert(kary_most_leaves(2) == 1u << 31 && kary_most_leaves(3) == 1162261467u &&
              kary_most_leaves(4) == 1u << 30 && kary_most_leaves(8) == 1u << 30);
}  // namespace bvhbench
#endif
#endif
