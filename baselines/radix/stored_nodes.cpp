// SPDX-License-Identifier: MIT
#include "baselines/radix/stored_nodes.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace bvhbench {
namespace {

using Children = std::array<uint, 2>;

}  // namespace

std::size_t radix_node_bytes(const BoxFormat& format)
{
    if (format.number == BOX_F32)
        return sizeof(RadixNode);
    constexpr std::size_t word = sizeof(uint);
    return sizeof(Children) + (format.box_bytes() + word - 1) / word * word;
}

std::vector<RadixNode> read_radix_nodes(std::span<const std::byte> stored,
                                        const BoxRounding& rounding)
{
    const BoxFormat& format = *rounding.format;
    const std::size_t bytes = radix_node_bytes(format);
    std::vector<RadixNode> nodes(stored.size() / bytes);
    if (format.number == BOX_F32) {
        std::ranges::copy(stored, std::as_writable_bytes(std::span(nodes)).begin());
        return nodes;
    }
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const std::span<const std::byte> one = stored.subspan(k * bytes, bytes);
        Children children;
        std::memcpy(children.data(), one.data(), sizeof children);
        nodes[k] = radix_node(rounding.read(one.subspan(sizeof children, format.box_bytes())),
                              children[0], children[1]);
    }
    return nodes;
}

std::vector<Aabb> read_boxes(std::span<const std::byte> stored, const BoxRounding& rounding)
{
    const std::size_t bytes = rounding.format->box_bytes();
    std::vector<Aabb> boxes;
    if (rounding.format->number == BOX_F32) {
        boxes.resize(stored.size() / sizeof(Aabb));
        std::ranges::copy(stored, std::as_writable_bytes(std::span(boxes)).begin());
        return boxes;
    }
    for (std::size_t from = 0; from < stored.size(); from += bytes)
        boxes.push_back(rounding.read(stored.subspan(from, bytes)));
    return boxes;
}

}  // namespace bvhbench
