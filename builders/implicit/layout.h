// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "builders/builder.h"
#include "geometry/bits.h"

namespace bvhbench {

/// A binary tree without pointers: all leaves are on one level, and each level is stored from its left end.
///
/// The children of the node at position p of a level are at positions 2p and 2p + 1 of the next. Layouts differ only in how
/// many nodes of a level they store: the real ones (oibvh) or all (perfect).
struct ImplicitLayout {
    uint (*stored_on)(uint leaves, uint level);   ///< Nodes stored on a level.
    uint (*first_slot)(uint leaves, uint level);  ///< Slot of the first of them.
    std::string_view build_groups;                ///< Kernel file, a work-group per subtree.
    std::string_view build_items;                 ///< Kernel file, a work-item per subtree.
    std::string_view access;  ///< Access header, as specified in builders/device_tree.h.
};

/// Level of the leaves; the root is level 0.
constexpr uint implicit_leaf_level(uint leaves) { return ceil_log2(leaves); }

/// Nodes of a level that have a leaf below them; other stored nodes are padding.
constexpr uint implicit_used_on(uint leaves, uint level)
{
    return divided_up(leaves, 1u << (implicit_leaf_level(leaves) - level));
}

/// How subtrees of one level are joined by the subtree above them.
enum class Meeting {
    between_launches,  ///< Several launches; groups do not interact within one (the paper's multi-kernel).
    by_local_atomics,  ///< The same as printed: work-items of a group meet node by node through local atomics.
    by_climbing,  ///< One launch; subtrees meet node by node through global atomics (the paper's single-kernel).
    by_handoff,  ///< One launch; the last of the groups below a subtree goes on with it.
    by_waiting,  ///< One launch; some groups wait for subtrees. Replaces by_handoff where groups may wait.
};

/// Creates a builder of Algorithm 1 over `layout`, with kernels for the kind of device.
std::unique_ptr<Builder> make_implicit_builder(Programs& programs, const BuilderCard& card,
                                               const ImplicitLayout& layout, Meeting meeting,
                                               const BuildOptions& options);

/// Creates a builder of the same tree, for a layout without padding. Host threads, as many as a CPU device has cores, build the
/// hierarchy over leaves that the device has ordered.
std::unique_ptr<Builder> make_host_implicit_builder(Programs& programs, const BuilderCard& card,
                                                    const ImplicitLayout& layout,
                                                    const BuildOptions& options);

}  // namespace bvhbench
