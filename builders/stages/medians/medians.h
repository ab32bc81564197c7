// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "builders/stages/kernel_form.h"
#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"
#include "geometry/aabb.h"

namespace bvhbench {

/// log2 of the leaves that a group orders in local memory.
constexpr uint median_block_height = 10;

/// How medians are cut up. `median_shape` says how on a device; other values are for tests.
struct MedianShape {
    KernelForm form = KernelForm::of_device;
    uint block_height = median_block_height;
    /// Groups only: work-items in a group, a power of two from 32, at most 2^block_height.
    uint group_size = 256;
};

/// As the device is tuned.
MedianShape median_shape(const Device& device, KernelForm form = KernelForm::of_device);

/// Puts every aligned block of 2^block_height leaves into the order of exact median splits.
///
/// The blocks are subtrees of a tree without pointers, and within one each split is the tree's own: of a node
/// at a height above the leaves, 2^(height - 1) leaves go left, or all there are. They are the first along the
/// axis with the cheapest halves, equals by id (geometry/split.h). What is in which block stays.
class BlockMedians {
public:
    explicit BlockMedians(Programs& programs, MedianShape shape = {});

    /// Take scratch memory for `size` leaves.
    void plan(Arena& arena, std::size_t size);

    /// Enqueue, as part of the stage begun: `ids` is reordered in place. Does not wait.
    void enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids, Queue& queue);

private:
    MedianShape shape_;
    cl::Kernel kernel_;
    Buffer<ulong> keys_;  ///< chunks only, one a leaf
};

/// Fills an array with 0, 1, 2, … Owns no memory.
class NumberAll {
public:
    explicit NumberAll(Programs& programs)
        : kernel_(programs.kernel("builders/stages/ids.cl", "number_all"))
    {}

    /// Enqueue, as part of the stage begun. Does not wait.
    void enqueue(const Buffer<uint>& numbers, Queue& queue);

private:
    cl::Kernel kernel_;
};

/// The same on the host, slowly and obviously: the oracle for the kernels, equal bit for bit.
void host_block_medians(std::span<const Aabb> boxes, std::span<uint> ids, uint block_height);

}  // namespace bvhbench
