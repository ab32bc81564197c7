// SPDX-License-Identifier: MIT
#pragma once

#include "device/buffer.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// Keeps a GPU busy for some tens of microseconds before a sample, untimed, so that the sample's launches wait in the queue
/// when the first of them starts. Else a build of a few short launches is as long as the host takes to enqueue them, which
/// is the host's time and not the device's. NVBench holds its streams for the same reason.
class HeadStart {
public:
    /// Throws what compiling throws. On a CPU, which shares its cores with the host, there is nothing to do.
    explicit HeadStart(Programs& programs, const Queue& queue);

    /// Enqueue it. Waits for nothing.
    void give(const Queue& queue);

private:
    cl::Kernel busy_;
    Buffer<cl_uint> word_;
};

}  // namespace bvhbench
