// SPDX-License-Identifier: MIT
#pragma once

#include "builders/stages/object_runs.h"
#include "builders/stages/sort.h"
#include "device/program.h"

namespace bvhbench {

/// The order of the frame before, kept aside: builds of the next frame try it before they sort. Leaves are in order in
/// it if their codes ascend, those of equal codes by their ids: then a stable sort would leave them as they are.
class StandingOrder {
public:
    StandingOrder(Programs& programs, unsigned code_bits, KernelForm form);

    /// Take room for `size` leaves.
    void plan(Arena& arena, std::size_t size);

    /// Write down that nobody has found anything yet. Waits.
    void prepare(const cl::CommandQueue& queue);

    /// Keep what `ids` hold of the first `count` leaves, or of the runs that are lined up. Neither is timed.
    void take(const cl::CommandQueue& queue, const Buffer<uint>& ids, uint count);
    void take(const cl::CommandQueue& queue, const Buffer<uint>& ids, const ObjectRuns& runs);

    /// Begin the stage `sort`: try it on the codes of as many leaves as were taken, at least one. What the sort behind
    /// it must be handed. Does not wait.
    SortUnlessIdle enqueue_try(const Buffer<uint>& codes, Queue& queue);

    /// If it held, the codes go from `codes` to `ordered`, where the sort would have left them; by way of `between` if
    /// these are one and the same.
    void enqueue_codes(const Buffer<uint>& codes, const Buffer<uint>& ordered,
                       const Buffer<uint>& between, Queue& queue);

    /// Enqueue, as part of the stage begun: sorted ids of the runs that are lined up go to their objects' places
    /// among `ids`, unless nothing was sorted.
    void enqueue_put(const Buffer<uint>& sorted, const Buffer<uint>& ids, const ObjectRuns& runs,
                     const SortUnlessIdle& unless, Queue& queue);

    /// Whether it held when it was tried last. Waits.
    bool held(const cl::CommandQueue& queue) const;

private:
    void launch(cl::Kernel& kernel, std::int64_t moved_bytes, Queue& queue) const;

    KernelForm form_;
    unsigned words_;
    std::size_t chunks_;
    cl::Kernel take_, put_, try_, order_, copy_;
    uint count_ = 0;
    uint build_ = 0;  ///< the last that tried it
    Buffer<uint> standing_;
    Buffer<uint> unsorted_;  ///< one: the last build that found it broken
};

}  // namespace bvhbench
