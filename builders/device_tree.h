// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <string_view>
#include <vector>

#include "builders/box_format.h"
#include "builders/tree.h"
#include "device/buffer.h"
#include "device/queue.h"
#include "geometry/forest.h"

namespace bvhbench {

/// The trees of a frame's objects in device memory, often of one, which kernels walk through their layout's access
/// header. The header defines
///
///     FOREST_PARAMETERS, FOREST    parameters as `bind` sets them; the same as arguments
///     PICK_TREE(object)            declares the variables of TREE: one object's tree, behind its ForestObject
///     TREE_PARAMETERS, TREE        that tree as parameters, `leaves` among them, and as arguments
///     tree_root(TREE)              a node: a word
///     tree_leaf(TREE, k)           the leaf at place k in the object's leaf order
///     tree_is_leaf(TREE, node)
///     tree_triangle(TREE, leaf)    the triangle of a leaf
///     tree_left(TREE, node), tree_right(TREE, node)         of inner nodes; TREE_NONE for a virtual right
///     tree_box(TREE, node)
///     TREE_CHILD_BITS              log2 of the children that a node has at most; from 2 on the tree is wide, which is
///                                  told below
///     tree_row, tree_row_end, tree_row_box                  of a binary implicit tree's level: places of its nodes by
///                                  their labels, for walks that stay on some levels
///     TREE_IMPLICIT                1: all leaves are on one level and arithmetic finds every relative:
///                                  tree_next, the node after a node's subtree in depth-first order, or
///                                  TREE_NONE; tree_descendant, Eq. (12), or TREE_NONE if virtual;
///                                  tree_ancestor, Eq. (13); tree_level and tree_leaf_level; all in levels
///                                  of its own, TREE_CHILD_BITS of a binary tree's
///                                  0: inner nodes have numbers, tree_inner(TREE, k) for k + 1 < leaves, and
///                                  every node has one, tree_number(TREE, node), leaves after inner nodes; the
///                                  objects' trees are parts of one, PICK_WHOLE_TREE, and nodes mean the same in all
///
/// and is compiled with SORTED_LEAVES: 1 if leaf boxes are in leaf order, 0 if in mesh order behind ids; and with
/// BOX_FORMAT (geometry/box_side.h), unless boxes are floats.
///
/// A wide tree is implicit. Its children are tree_left and those next to it instead of tree_right, and their boxes are
/// tested together:
///
///     tree_slot(TREE, node)                     where an inner node is stored
///     tree_child_box(TREE, slot, k)             of child k of the node there
///     tree_children_meeting(TREE, slot, box)    a bit a child: whether its box overlaps; of none, anything
///     tree_children_from(TREE, node, first)     a bit a child: whether it has leaves from place `first` on
class DeviceTree : public Tree {
public:
    const Queue* queue =
        nullptr;  ///< where the last build was enqueued; set before anything is read

    std::vector<ForestObject> objects;  ///< of each object's tree
    Buffer<ForestObject> device_objects;

    /// One object's tree as `spelled_out` tells of the only one.
    virtual HostTree spelled_out_object(uint object) const = 0;
    HostTree spelled_out() const final
    {
        assert(objects.size() == 1);
        return spelled_out_object(0);
    }

    virtual uint leaf_count() const = 0;  ///< of all objects
    virtual const BoxFormat& box_format() const { return float_boxes(); }
    virtual bool has_sorted_leaves() const = 0;

    virtual std::string_view access_header() const = 0;
    virtual bool is_implicit() const = 0;          ///< as the header says
    virtual uint child_bits() const { return 1; }  ///< TREE_CHILD_BITS

    /// Nodes on the longest way from a root to a leaf, at most, and exactly in the largest implicit tree.
    virtual uint most_levels() const = 0;

    /// Bits of the largest label, a leaf's, of an implicit tree.
    uint label_bits() const { return child_bits() * (most_levels() - 1) + 1; }

    /// Set the header's parameters from `first` on; returns the index after them.
    virtual cl_uint bind(cl::Kernel& kernel, cl_uint first) const = 0;
};

/// Set neighbouring arguments from `first` on; returns the index after them.
template <class... Arguments>
cl_uint set_arguments_from(cl::Kernel& kernel, cl_uint first, const Arguments&... arguments)
{
    (kernel.setArg(first++, memory_of(arguments)), ...);
    return first;
}

}  // namespace bvhbench
