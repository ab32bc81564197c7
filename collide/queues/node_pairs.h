// SPDX-License-Identifier: MIT
//
// Shared by the traversals over pairs of nodes, bvtt and front.
#pragma once

#include <algorithm>
#include <string>

#include "builders/device_tree.h"
#include "collide/parameters.h"
#include "geometry/bits.h"

namespace bvhbench {

/// Entries of a list that a work-item buffers before it writes them out, in the form for few cores.
inline constexpr uint node_pairs_in_block = 256;

/// Most work-groups per compute unit.
inline constexpr std::size_t groups_of_pairs_per_unit = 16;

/// Bits of the node in the word that encodes it (queues/nodes.clh); the remaining bits are the object.
inline uint node_bits(const DeviceTree& tree)
{
    return tree.objects.size() > 1 && tree.is_implicit() ? tree.label_bits() : 32;
}

/// Returns the reason why objects and nodes of these trees do not fit into one word, as a sentence; empty if they do.
inline std::string naming_objection(std::string_view collider, const DeviceTree& tree)
{
    const auto objects = static_cast<uint>(tree.objects.size());
    if (node_bits(tree) == 32 || node_bits(tree) + ceil_log2(objects) <= 32)
        return {};
    return std::string(collider) + " names an object and its node in 32 bits, too few for " +
           std::to_string(objects) + " objects with labels of up to " +
           std::to_string(tree.label_bits()) + " bits";
}

/// Number of work-groups for `tasks` tasks, `a_group` of which a group does at a time: enough that each has work, at most what
/// fills the device.
inline std::size_t group_count(const Device& device, std::size_t tasks, std::size_t a_group)
{
    const std::size_t most =
        groups_of_pairs_per_unit * device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    return std::clamp<std::size_t>((tasks + a_group - 1) / a_group, 1, most);
}

}  // namespace bvhbench
