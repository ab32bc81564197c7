// SPDX-License-Identifier: MIT
//
// Inner nodes of radix trees as kernels store them (node_words.clh), for the host.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "baselines/radix/node.h"
#include "builders/box_format.h"

namespace bvhbench {

/// Bytes of an inner node whose box is in `format`.
std::size_t radix_node_bytes(const BoxFormat& format);

/// Nodes that are stored one behind the other, their boxes read back by `rounding`.
std::vector<RadixNode> read_radix_nodes(std::span<const std::byte> stored,
                                        const BoxRounding& rounding);

/// The same of boxes that are stored alone.
std::vector<Aabb> read_boxes(std::span<const std::byte> stored, const BoxRounding& rounding);

/// A node of these parts.
inline RadixNode radix_node(const Aabb& box, uint left, uint right)
{
    return {box.min_x, box.min_y, box.min_z, left, box.max_x, box.max_y, box.max_z, right};
}

}  // namespace bvhbench
