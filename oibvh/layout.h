// SPDX-License-Identifier: MIT
//
// The ostensibly-implicit layout: all formulas of Section 3 and Appendix A, for host and device.
//
// Nodes carry implicit indices: breadth-first labels in the perfect binary tree, root 0. Real nodes fill
// each level from the left; the rest of the level is virtual and is never stored.
//
//     t = 5              0                  level 0
//                    1       2              level 1
//                  3   4   5   (6)          level 2     1 virtual
//                 7 8 9 10 11 (12 13 14)    level 3     3 virtual = L_v
//
// Stored order:   0 | 1 2 | 3 4 5 | 7 8 9 10 11         11 slots = 2t - 1 + popcount(L_v)
//
// Node 5 has one child: a support node. The left child of a real node is always real.
// Valid for every t from 1 to 2^31; implicit indices and slots then fit in 32 bits.
#ifndef BVHBENCH_OIBVH_LAYOUT_H
#define BVHBENCH_OIBVH_LAYOUT_H

#include "geometry/bits.h"

SHARED_BEGIN

/// Shape of a tree, determined by the number of leaves.
typedef struct {
    uint leaves;          ///< t, at least 1 and at most 2^31
    uint virtual_leaves;  ///< L_v, Eq. (1)
    uint leaf_level;      ///< ceil(log2 t); the root is level 0
} OiShape;

SHARED_FN OiShape oi_shape(uint leaves)
{
    OiShape shape;
    shape.leaves = leaves;
    shape.leaf_level = ceil_log2(leaves);
    shape.virtual_leaves = (1u << shape.leaf_level) - leaves;  // Eq. (1)
    return shape;
}

/// Returns N_c, the nodes of the perfect binary tree over the same leaves: Eq. (2).
SHARED_FN uint oi_perfect_node_count(OiShape shape) { return (2u << shape.leaf_level) - 1u; }

/// Returns the level of implicit index i: floor(log2(i + 1)), Sec. 3.2.
SHARED_FN uint oi_level(uint i) { return floor_log2(i + 1u); }

/// Returns the implicit index of the leftmost node on a level.
SHARED_FN uint oi_first(uint level) { return (1u << level) - 1u; }

/// Returns L_vl, the virtual nodes on a level: Eq. (8).
SHARED_FN uint oi_virtual_on(OiShape shape, uint level)
{
    return shape.virtual_leaves >> (shape.leaf_level - level);
}

/// Returns the real nodes on a level.
SHARED_FN uint oi_real_on(OiShape shape, uint level)
{
    return (1u << level) - oi_virtual_on(shape, level);
}

/// Returns the virtual nodes on a level and all levels above it, given that level's virtual count: Eq. (6), (10).
///
/// Eq. (5) sums perfect trees of virtual nodes, one for each power of two in L_v (Eq. (4)): 2^y leaves make 2 * 2^y - 1 nodes.
/// The powers of two in a number are its set bits, so the sum is 2 L_v minus the number of set bits.
SHARED_FN uint oi_virtual_up_to(uint virtual_on_level)
{
    return 2u * virtual_on_level - popcount(virtual_on_level);
}

/// Returns N_v, the virtual nodes of the whole tree: Eq. (6).
SHARED_FN uint oi_virtual_node_count(OiShape shape)
{
    return oi_virtual_up_to(shape.virtual_leaves);
}

/// Returns N_r, the number of stored nodes: Eq. (7), which is Eq. (3) with (2) and (6) inserted.
SHARED_FN uint oi_node_count(OiShape shape)
{
    return 2u * shape.leaves - 1u + popcount(shape.virtual_leaves);
}

SHARED_FN bool oi_is_real(OiShape shape, uint i)
{
    const uint level = oi_level(i);
    return i - oi_first(level) < oi_real_on(shape, level);
}

/// Returns the slot of the leftmost node on a level: Eq. (9). The nodes of a level are contiguous.
///
/// Eq. (10) needs L_vl of the level above. Shifting this level's count once more gives that number, and 0 at the root, so no
/// level is a special case and no shift reaches 32.
SHARED_FN uint oi_first_slot(OiShape shape, uint level)
{
    return oi_first(level) - oi_virtual_up_to(oi_virtual_on(shape, level) >> 1u);
}

/// Returns i_m, the slot of node i: Eq. (9).
SHARED_FN uint oi_slot(OiShape shape, uint i)
{
    return i - oi_virtual_up_to(oi_virtual_on(shape, oi_level(i)) >> 1u);
}

/// True if every node of a level is real. The paper's condition (end of Sec. 3.2) holds for no level; this one follows from its
/// definitions.
SHARED_FN bool oi_is_full(OiShape shape, uint level) { return oi_virtual_on(shape, level) == 0u; }

/// child(i, 1), child(i, 2) and parent(i), App. A.
SHARED_FN uint oi_left(uint i) { return 2u * i + 1u; }
SHARED_FN uint oi_right(uint i) { return 2u * i + 2u; }
SHARED_FN uint oi_parent(uint i) { return (i - 1u) >> 1u; }

/// Returns the k-th descendant of i, n levels down, 0 <= k < 2^n: Eq. (12).
SHARED_FN uint oi_descendant(uint i, uint n, uint k) { return (i << n) + (1u << n) - 1u + k; }

/// Returns the ancestor of j, n levels up: Eq. (13). The shift drops k, which is not needed.
SHARED_FN uint oi_ancestor(uint j, uint n) { return ((j + 1u) >> n) - 1u; }

SHARED_END

#ifndef __OPENCL_C_VERSION__
namespace bvhbench {
static_assert(sizeof(OiShape) == 12);
static_assert(oi_node_count(oi_shape(5)) == 11);  // the drawing above
static_assert(oi_slot(oi_shape(5), 7) == 6);      // node 7 follows node 5: node 6 is virtual

// Table 1, row "Oi-BVH", all five meshes; and row "Perfect Implicit BVH".
static_assert(oi_node_count(oi_shape(144046)) == 288100 &&
              oi_perfect_node_count(oi_shape(144046)) == 524287);
static_assert(oi_node_count(oi_shape(412669)) == 825344 &&
              oi_perfect_node_count(oi_shape(412669)) == 1048575);
static_assert(oi_node_count(oi_shape(871306)) == 1742621 &&
              oi_perfect_node_count(oi_shape(871306)) == 2097151);
static_assert(oi_node_count(oi_shape(1087474)) == 2174957 &&
              oi_perfect_node_count(oi_shape(1087474)) == 4194303);
static_assert(oi_node_count(oi_shape(2880000)) == 5760004 &&
              oi_perfect_node_count(oi_shape(2880000)) == 8388607);
}  // namespace bvhbench
#endif
#endif
