// SPDX-License-Identifier: MIT
#pragma once

#include "builders/stages/kernel_form.h"
#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// Prefix sums in place: each value becomes the sum of all before it, modulo 2^32.
class ScanStage {
public:
    explicit ScanStage(Programs& programs, KernelForm form = KernelForm::of_device);

    /// Take the scratch for `size` values.
    void plan(Arena& arena, std::size_t size);

    /// Enqueue, as part of the stage begun, for as many values as planned. Does not wait.
    void enqueue(const Buffer<uint>& values, Queue& queue);

private:
    std::size_t partial_count(std::size_t size) const;

    KernelForm form_;
    std::size_t chunks_;
    cl::Kernel sum_, scan_partials_, scan_;
    Buffer<uint> partials_;  ///< one a group or chunk
};

}  // namespace bvhbench
