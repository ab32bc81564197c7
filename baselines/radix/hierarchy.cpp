// SPDX-License-Identifier: MIT
#include "baselines/radix/hierarchy.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "baselines/parameters.h"
#include "builders/stages/kernel_form.h"
#include "geometry/bits.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

using Children = std::array<uint, 2>;

/// Bytes of an inner node whose box is in `format`.
std::size_t node_bytes(const BoxFormat& format)
{
    if (format.number == BOX_F32)
        return sizeof(RadixNode);
    constexpr std::size_t word = sizeof(uint);
    return sizeof(Children) + (format.box_bytes() + word - 1) / word * word;
}

}  // namespace

RadixLaunch::RadixLaunch(const Device& device, const BuildOptions& options)
    : group_size(options.group_size)
{
    const auto most = device.cl.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
    if (group_size == 0 && device.is_cpu()) {
        group_size = 1;
        most_items = chunk_count(device);
    } else if (group_size == 0) {
        group_size = std::min<std::size_t>(device.tuned(radix_group_size), std::bit_floor(most));
    } else if (!std::has_single_bit(group_size) || group_size > most) {
        throw BadUsage("a group size is a power of two up to " + std::to_string(most) + " on " +
                       device.name() + ", not " + std::to_string(group_size));
    }
}

void RadixLaunch::operator()(Queue& queue, const cl::Kernel& kernel, uint count,
                             std::size_t moved_bytes) const
{
    const std::size_t items = most_items != 0 ? std::min<std::size_t>(count, most_items) : count;
    const std::size_t groups = (items + group_size - 1) / group_size;
    queue.launch(kernel, groups * group_size, group_size, static_cast<std::int64_t>(moved_bytes));
}

void RadixHierarchy::prepare(const cl::CommandQueue& queue)
{
    arrivals_.upload(queue, std::vector<uint>(arrivals_.size(), 0u));
}

Buffer<std::byte> RadixHierarchy::take_nodes(Arena& arena) const
{
    return arena.take<std::byte>(leaves_.inner() * node_bytes(*leaves_.format), Use::tree);
}

std::vector<RadixNode> RadixHierarchy::download(const cl::CommandQueue& queue,
                                                const BoxRounding& rounding, uint& root) const
{
    root = 0;
    const BoxFormat& format = *rounding.format;
    const std::vector<std::byte> stored = nodes_.download(queue);
    const std::size_t bytes = node_bytes(format);
    std::vector<RadixNode> nodes(stored.size() / bytes);
    if (format.number == BOX_F32) {
        std::ranges::copy(stored, std::as_writable_bytes(std::span(nodes)).begin());
        return nodes;
    }
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const auto one = std::span(stored).subspan(k * bytes, bytes);
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
    for (std::size_t from = 0; from < stored.size(); from += bytes)
        boxes.push_back(rounding.read(stored.subspan(from, bytes)));
    return boxes;
}

}  // namespace bvhbench
