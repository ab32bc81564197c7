// SPDX-License-Identifier: MIT
//
// Measured limits that stage times are compared with, and work that runs between samples to make them comparable.
#pragma once

#include <limits>

#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// The measured copy bandwidth of the device's memory.
struct CopyRate {
    /// Bytes read plus bytes written per second of median device time; 0 if the device clock gave a time of 0.
    double bytes_per_s = 0;
    std::size_t buffer_bytes = 0;  ///< size of the source; with the target larger than the caches
    int samples = 0;
};

/// Measures the rate of copying one large buffer to another with a kernel that copies 16 bytes at a time. The buffers have no more
/// than `most_bytes`, which must be 16 or more.
CopyRate measure_copy_rate(Programs& programs, Queue& queue,
                           std::size_t most_bytes = std::numeric_limits<std::size_t>::max());

/// Compares the device's clock with the host's while a small buffer is copied, by the kernel of measure_copy_rate. Throws BadClock if
/// they disagree, Unavailable if there is no room, and what compiling throws.
void check_clocks(Programs& programs, Queue& queue);

/// The measured cost of a launch with almost no work.
struct LaunchCost {
    /// Nanoseconds of device time per launch: span of `launches` consecutive launches, divided by `launches`; the median.
    double ns = 0;
    int launches = 0;  ///< consecutive launches per sample
    int samples = 0;
};

/// Measures consecutive launches of a kernel that reads one word, with one group per compute unit.
LaunchCost measure_launch_cost(Programs& programs, Queue& queue);

/// Keeps a GPU busy for some tens of microseconds before a sample, untimed, so that the sample's launches are already queued
/// when the first of them starts. Without it, a build of a few short launches takes as long as the host needs to enqueue them:
/// host time, not device time. NVBench blocks its streams for the same reason.
class HeadStart {
public:
    /// Does nothing on a CPU, which shares its cores with the host. Throws what compiling throws.
    explicit HeadStart(Programs& programs, const Queue& queue);

    /// Enqueues the work. Does not wait.
    void give(const Queue& queue);

private:
    cl::Kernel busy_;
    Buffer<cl_uint> word_;
};

/// A kernel with enough work-items to fill a device, and the vectors that it works on, zeros at first.
struct FillingKernel {
    cl::Kernel kernel;
    Arena arena;  ///< kept, so that the memory stays counted as taken
    Buffer<cl_uint4> memory;
    std::size_t work_items, group;

    /// Throws Unavailable if there is no room for `count` vectors, and what compiling throws.
    FillingKernel(Programs& programs, const Queue& queue, const char* name, std::size_t count);
};

/// Evicts a sample's data from the device's caches by reading and writing a buffer of twice their size. On a CPU these are the
/// host's caches; with other devices the host's caches are not flushed.
class CacheFlush {
public:
    /// Allocates the buffer and flushes once. Throws like FillingKernel.
    CacheFlush(Programs& programs, const Queue& queue);

    /// Flushes the caches, untimed. Waits.
    void flush(const Queue& queue);

private:
    FillingKernel walk_;
};

/// A fixed amount of work that is timed between samples. If it takes longer than before, the machine has become slower for a
/// reason that no builder causes. It needs no vendor-specific counters.
class Calibration {
public:
    /// Allocates memory and runs once. Throws like FillingKernel.
    Calibration(Programs& programs, Queue& queue);

    /// Runs the work and returns the median device time of a few launches in nanoseconds. Waits.
    std::int64_t take(Queue& queue);

private:
    FillingKernel work_;
};

}  // namespace bvhbench
