// SPDX-License-Identifier: MIT
#pragma once

#include "device/buffer.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// Fills an array with 0, 1, 2, … Owns no memory.
class NumberAll {
public:
    explicit NumberAll(Programs& programs);

    /// Enqueue, as part of the stage begun. Does not wait.
    void enqueue(const Buffer<uint>& numbers, Queue& queue);

private:
    cl::Kernel kernel_;
};

}  // namespace bvhbench
