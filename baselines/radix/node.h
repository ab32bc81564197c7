// SPDX-License-Identifier: MIT
//
// A radix tree over n leaves has n - 1 inner nodes, indexed as in [Karras2012, Sec. 3]. The root is node 0. A node that covers
// leaves `first` to `last` is node `last` if it is a left child and node `first` if it is a right child. So the children of a
// node that splits after leaf s have indices s and s + 1; a child that covers one leaf is that leaf.
//
//     leaves       0   1   2   3   4         root 0 = leaves 0 to 4, split after 1
//                  +---1   2-------+         its children: inner 1 (leaves 0, 1), inner 2 (leaves 2 to 4)
//                          2   3---+         children of inner 2: leaf 2, inner 3
#ifndef BVHBENCH_BASELINES_RADIX_NODE_H
#define BVHBENCH_BASELINES_RADIX_NODE_H

#include "geometry/aabb.h"

SHARED_BEGIN

/// An inner node: 32 bytes, which two aligned 16-byte loads read and which fill one memory sector of a GPU.
typedef struct {
    float min_x, min_y, min_z;
    uint left;  ///< encoded by radix_child
    float max_x, max_y, max_z;
    uint right;  ///< encoded by radix_child
} RadixNode;

#define RADIX_LEAF 0x80000000u

/// Encodes a reference to leaf or inner node `index`.
SHARED_FN uint radix_child(uint index, bool is_leaf)
{
    return is_leaf ? index | RADIX_LEAF : index;
}

SHARED_FN bool radix_is_leaf(uint child) { return (child & RADIX_LEAF) != 0u; }

SHARED_FN uint radix_index(uint child) { return child & ~RADIX_LEAF; }

#ifndef __OPENCL_C_VERSION__
/// Returns a node with the given box and children.
inline RadixNode radix_node(const Aabb& box, uint left, uint right)
{
    return {box.min_x, box.min_y, box.min_z, left, box.max_x, box.max_y, box.max_z, right};
}
static_assert(sizeof(RadixNode) == 32);
#endif

SHARED_END

#endif
