// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "builders/builder.h"
#include "geometry/bits.h"

namespace bvhbench {

/// A binary tree whose nodes need no pointers: all leaves on one level, each level stored from its left end.
///
/// The children of the node at position p of a level are at positions 2p and 2p + 1 of the next. Layouts
/// differ only in how much of a level they store: what is real (oibvh) or all of it (perfect).
struct ImplicitLayout {
    uint (*stored_on)(uint leaves, uint level);   ///< nodes stored on a level
    uint (*first_slot)(uint leaves, uint level);  ///< where the first of them is
    std::string_view build_groups;                ///< kernel file, a work-group a subtree
    std::string_view build_items;                 ///< kernel file, a work-item a subtree
    std::string_view access;                      ///< header, as builders/device_tree.h says
};

/// Level of the leaves; the root is level 0.
constexpr uint implicit_leaf_level(uint leaves) { return ceil_log2(leaves); }

/// Nodes of a level that have a leaf below them; the rest of what a layout stores is padding.
constexpr uint implicit_used_on(uint leaves, uint level)
{
    return divided_up(leaves, 1u << (implicit_leaf_level(leaves) - level));
}

/// How launches meet.
enum class Meeting {
    between_launches,  ///< several launches, groups never meet inside one (the paper's multi-kernel)
    by_handoff,  ///< one launch, subtrees meet through global atomics (the paper's single-kernel)
    by_waiting,  ///< one launch, a few groups wait for subtrees; what by_handoff becomes where they may
};

/// A builder of Algorithm 1 over any such layout, by kernels that suit the kind of device.
std::unique_ptr<Builder> make_implicit_builder(Programs& programs, const BuilderCard& card,
                                               const ImplicitLayout& layout, Meeting meeting,
                                               const BuildOptions& options);

/// The same tree of a layout without padding, its hierarchy made by threads of the host, as many as a CPU device has
/// cores, from leaves that the device has lined up.
std::unique_ptr<Builder> make_host_implicit_builder(Programs& programs, const BuilderCard& card,
                                                    const ImplicitLayout& layout,
                                                    const BuildOptions& options);

}  // namespace bvhbench
