// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "device/arena.h"
#include "device/buffer.h"
#include "device/filling_launch.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// Empties a device's caches of what a sample would find there: reads and writes a buffer of twice their size. On a CPU
/// device the host's caches are the device's; on others they are left alone.
class CacheFlush {
public:
    /// Takes the buffer. Throws Unavailable if there is no room, and what compiling throws.
    CacheFlush(Programs& programs, Queue& queue);

    /// Enqueue it, untimed, and wait.
    void flush(const Queue& queue);

private:
    cl::Kernel walk_;
    std::optional<Arena> arena_;  ///< kept, so that what it takes stays counted
    Buffer<cl_uint4> memory_;
    FillingLaunch launch_{};
};

}  // namespace bvhbench
