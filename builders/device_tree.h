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

/// Trees of a frame's objects (one or several) in device memory, which kernels traverse through the access header of the
/// layout. The header defines
///
///     FOREST_PARAMETERS, FOREST    kernel parameters set by `bind`; the same as arguments
///     PICK_TREE(object)            declares the variables of TREE for one object, from its ForestObject
///     TREE_PARAMETERS, TREE        that tree as parameters, `leaves` among them, and as arguments
///     tree_root(TREE)              root node; a node is one word
///     tree_leaf(TREE, k)           leaf k in the object's leaf order
///     tree_is_leaf(TREE, node)
///     tree_triangle(TREE, leaf)    the triangle of a leaf
///     tree_left(TREE, node), tree_right(TREE, node)         of inner nodes; TREE_NONE for a virtual right child
///     tree_box(TREE, node)
///     TREE_CHILD_BITS              log2 of the arity; at 2 or more the tree is wide (see below)
///     tree_row, tree_row_end, tree_row_box                  binary implicit trees: where a level's boxes are by node
///                                  label, for traversals that stay on some levels
///     TREE_IMPLICIT                1: all leaves are on one level and relatives are computed:
///                                  tree_next, the node after a node's subtree in depth-first order, or
///                                  TREE_NONE; tree_descendant, Eq. (12), or TREE_NONE if virtual;
///                                  tree_ancestor, Eq. (13); tree_level and tree_leaf_level. Levels are
///                                  those of the tree itself: one is TREE_CHILD_BITS levels of a binary tree
///                                  0: inner nodes have numbers, tree_inner(TREE, k) for k + 1 < leaves, and
///                                  every node has one, tree_number(TREE, node), leaves after inner nodes; the
///                                  objects' trees are parts of one, PICK_WHOLE_TREE, and a node is the same in all
///     TREE_IN_ORDER                0, only without TREE_IMPLICIT: leaves are not in the order of their places in the
///                                  tree, but tree_leaf ascends with the place; else not defined
///
/// and is compiled with SORTED_LEAVES (1: leaf boxes in leaf order; 0: in mesh order, reached through ids) and with BOX_FORMAT
/// (geometry/box_side.h) unless boxes are floats.
///
/// A wide tree is implicit. Its children are tree_left and the labels after it; there is no tree_right. Their boxes are tested
/// together:
///
///     tree_slot(TREE, node)                     slot of an inner node
///     tree_child_box(TREE, slot, k)             box of child k of the node in `slot`
///     tree_children_meeting(TREE, slot, box)    bit k is set if child k's box overlaps `box`; undefined for virtual children
///     tree_children_from(TREE, node, first)     bit k is set if child k has leaves at place `first` or later
class DeviceTree : public Tree {
public:
    const Queue* queue = nullptr;  ///< Queue of the last build; set before the tree is read.

    std::vector<ForestObject> objects;  ///< One per object.
    Buffer<ForestObject> device_objects;

    /// Returns a host copy of one object's tree; see `to_host_tree`.
    virtual HostTree object_to_host_tree(uint object) const = 0;
    HostTree to_host_tree() const final
    {
        assert(objects.size() == 1);
        return object_to_host_tree(0);
    }

    virtual uint leaf_count() const = 0;  ///< Leaves of all objects.
    virtual const BoxFormat& box_format() const { return float_boxes(); }
    virtual bool has_sorted_leaves() const = 0;

    virtual std::string_view access_header() const = 0;
    virtual bool is_implicit() const = 0;              ///< TREE_IMPLICIT of the access header.
    virtual bool is_in_order() const { return true; }  ///< TREE_IN_ORDER of the access header.
    /// True if the number of an inner node is its first leaf, of a left child its last one; only without TREE_IMPLICIT.
    virtual bool is_numbered_by_range() const { return false; }
    virtual uint child_bits() const { return 1; }  ///< TREE_CHILD_BITS of the access header.

    /// Upper bound of the nodes on a path from a root to a leaf; exact for the largest implicit tree.
    virtual uint most_levels() const = 0;

    /// Returns the bits of the largest label (of the last leaf) of an implicit tree.
    uint label_bits() const { return child_bits() * (most_levels() - 1) + 1; }

    /// Sets the kernel arguments of FOREST_PARAMETERS from index `first` on. Returns the next index.
    virtual cl_uint bind(cl::Kernel& kernel, cl_uint first) const = 0;
};

/// Sets consecutive kernel arguments from index `first` on. Returns the next index.
template <class... Arguments>
cl_uint set_arguments_from(cl::Kernel& kernel, cl_uint first, const Arguments&... arguments)
{
    (kernel.setArg(first++, memory_of(arguments)), ...);
    return first;
}

}  // namespace bvhbench
