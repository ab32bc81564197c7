// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "device/arena.h"
#include "device/buffer.h"
#include "device/filling_launch.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// A fixed piece of work, run again and again between samples: where it takes longer than before, the machine is slower,
/// whatever the reason, and no builder is to blame. It needs no counters of a vendor's.
class Calibration {
public:
    /// Takes its memory and runs once. Throws Unavailable if there is no room, and what compiling throws.
    Calibration(Programs& programs, Queue& queue);

    /// Run it: the median of a few launches in nanoseconds, on the device's clock. Waits.
    std::int64_t take(Queue& queue);

private:
    cl::Kernel work_;
    std::optional<Arena> arena_;  ///< kept, so that what it takes stays counted
    Buffer<cl_uint4> memory_;
    FillingLaunch launch_{};
};

}  // namespace bvhbench
