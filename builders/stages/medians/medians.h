// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "builders/stages/kernel_form.h"
#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"
#include "geometry/aabb.h"
#include "geometry/triangle.h"

namespace bvhbench {

/// log2 of the leaves that a group orders in local memory.
constexpr uint median_block_height = 10;

/// Launch parameters of the medians. `median_shape` returns those of a device; other values are for tests.
struct MedianShape {
    KernelForm form = KernelForm::of_device;
    uint block_height = median_block_height;
    /// Groups only: work-items per group, a power of two from 32 to 2^block_height.
    uint group_size = 256;
};

/// Returns the tuned parameters of `device`.
MedianShape median_shape(const Device& device, KernelForm form = KernelForm::of_device);

/// Puts every aligned block of 2^block_height leaves into the order of exact median splits.
///
/// Blocks are subtrees of an implicit tree. A node at height h above the leaves sends its first 2^(h - 1) leaves left (or all,
/// if it has no more), sorted by centre along the axis of the cheapest split, ties by id (geometry/split.h). No leaf changes
/// its block. Owns no memory.
class BlockMedians {
public:
    explicit BlockMedians(Programs& programs, MedianShape shape = {});

    /// Enqueues the reordering of `ids` in place, within the current stage. Does not block.
    void enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids, Queue& queue);

private:
    MedianShape shape_;
    cl::Kernel kernel_;
};

/// Fills an array with 0, 1, 2, ... Owns no memory.
class NumberAll {
public:
    explicit NumberAll(Programs& programs)
        : kernel_(programs.kernel("builders/stages/ids.cl", "number_all"))
    {}

    /// Enqueues the kernel within the current stage. Does not block.
    void enqueue(const Buffer<uint>& numbers, Queue& queue);

private:
    cl::Kernel kernel_;
};

/// Host version of BlockMedians: the oracle of the kernels, equal bit for bit.
void host_block_medians(std::span<const Aabb> boxes, std::span<uint> ids, uint block_height);

}  // namespace bvhbench
