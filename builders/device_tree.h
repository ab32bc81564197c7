// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "builders/tree.h"
#include "device/buffer.h"
#include "device/queue.h"
#include "geometry/dialect.h"

namespace bvhbench {

/// A tree in device memory, which kernels walk through its layout's access header. The header defines
///
///     TREE_PARAMETERS, TREE        parameters as `bind` sets them, `leaves` among them; the same as arguments
///     tree_root(TREE)              a node: a word. A tree of one leaf is not walked.
///     tree_leaf(TREE, k)           the leaf at place k in leaf order
///     tree_is_leaf(TREE, node), tree_place(TREE, node)      and back
///     tree_triangle(TREE, k)       the triangle of that leaf
///     tree_left(TREE, node), tree_right(TREE, node)         of inner nodes; TREE_NONE for a virtual right
///     tree_box(TREE, node)
///     TREE_IMPLICIT                1: all leaves are on one level and arithmetic finds every relative:
///                                  tree_next, the node after a node's subtree in depth-first order, or
///                                  TREE_NONE; tree_descendant, Eq. (12), or TREE_NONE if virtual; tree_level
///                                  0: inner nodes have numbers, tree_inner(TREE, k) for k + 1 < leaves, and
///                                  every node has one, tree_number(TREE, node), leaves after inner nodes
///
/// and is compiled with SORTED_LEAVES: 1 if leaf boxes are in leaf order, 0 if in mesh order behind ids.
class DeviceTree : public Tree {
public:
    const Queue* queue =
        nullptr;  ///< where the last build was enqueued; set before anything is read

    virtual uint leaf_count() const = 0;
    virtual bool has_sorted_leaves() const = 0;

    virtual std::string_view access_header() const = 0;
    virtual bool is_implicit() const = 0;  ///< as the header says

    /// Nodes on the longest way from the root to a leaf, at most, and exactly in an implicit tree.
    virtual uint most_levels() const = 0;

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
