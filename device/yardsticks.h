// SPDX-License-Identifier: MIT
//
// What times of stages are held against, and what is run between samples so that they are worth comparing.
#pragma once

#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// What the device's memory gives at best, measured.
struct CopyRate {
    /// Bytes read plus bytes written, over the median device time; 0 if the device's clock showed none.
    double bytes_per_s = 0;
    std::size_t buffer_bytes = 0;  ///< size of the source, larger than the caches
    int samples = 0;
};

/// Copy one large buffer to another with a plain 16-byte kernel, several times.
CopyRate measure_copy_rate(Programs& programs, Queue& queue);

/// What a launch takes that has next to nothing to do, measured.
struct LaunchCost {
    /// Device clock: the span of many launches in a row over their number; the median of `samples`.
    double ns = 0;
    int launches = 0;  ///< in a row
    int samples = 0;
};

/// Launch a kernel that reads one word, a group a compute unit, many times in a row, several times.
LaunchCost measure_launch_cost(Programs& programs, Queue& queue);

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

/// A kernel that keeps all of a device busy with vectors in memory, zeros at first.
struct FillingKernel {
    cl::Kernel kernel;
    Arena arena;  ///< kept, so that what it takes stays counted
    Buffer<cl_uint4> memory;
    std::size_t work_items, group;

    /// Throws Unavailable if there is no room for `count` vectors, and what compiling throws.
    FillingKernel(Programs& programs, const Queue& queue, const char* name, std::size_t count);
};

/// Empties a device's caches of what a sample would find there: reads and writes a buffer of twice their size. On a CPU
/// device the host's caches are the device's; on others they are left alone.
class CacheFlush {
public:
    /// Takes the buffer and runs once. Throws as FillingKernel.
    CacheFlush(Programs& programs, const Queue& queue);

    /// Enqueue it, untimed, and wait.
    void flush(const Queue& queue);

private:
    FillingKernel walk_;
};

/// A fixed piece of work, run again and again between samples: where it takes longer than before, the machine is slower,
/// whatever the reason, and no builder is to blame. It needs no counters of a vendor's.
class Calibration {
public:
    /// Takes its memory and runs once. Throws as FillingKernel.
    Calibration(Programs& programs, Queue& queue);

    /// Run it: the median of a few launches in nanoseconds, on the device's clock. Waits.
    std::int64_t take(Queue& queue);

private:
    FillingKernel work_;
};

}  // namespace bvhbench
