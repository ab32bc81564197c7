// SPDX-License-Identifier: MIT
#pragma once

#include "builders/stages/kernel_form.h"
#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// Exclusive prefix sums in place, modulo 2^32.
class ScanStage {
public:
    explicit ScanStage(Programs& programs, KernelForm form = KernelForm::of_device);

    /// Takes the scratch memory for `size` values.
    void plan(Arena& arena, std::size_t size);

    /// Enqueues the sums of all planned values within the current stage. Does not block.
    void enqueue(const Buffer<uint>& values, Queue& queue);

private:
    std::size_t partial_count(std::size_t size) const;

    KernelForm form_;
    std::size_t chunks_;
    cl::Kernel sum_, scan_partials_, scan_;
    Buffer<uint> partials_;  ///< One per group or chunk.
};

}  // namespace bvhbench
