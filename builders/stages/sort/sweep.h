// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// The passes of a radix sort in one launch each, in which groups wait for groups [Adinets2022]: for devices that let
/// groups wait. Digits have eight bits.
class DigitSweeps {
public:
    /// `group_size` work-items, a power of two from 32 (from 16 where a team is one work-item) to 512, take
    /// `keys_per_item` pairs each, or half as many of few pairs.
    DigitSweeps(Programs& programs, unsigned code_bits, uint group_size, uint keys_per_item);

    void plan(Arena& arena, std::size_t size);

    /// Write down what `enqueue` expects and leaves as it was. Waits.
    void prepare(const cl::CommandQueue& queue);

    /// Sort the first `count` from codes[0], with ids 0, 1, 2, …. Codes end in the buffer that the number of
    /// passes leads to, ids in `result`, by way of `other`. Does not wait.
    void enqueue(const std::array<Buffer<uint>, 2>& codes, const Buffer<uint>& result,
                 const Buffer<uint>& other, uint count, Queue& queue);

private:
    uint keys_for(std::size_t size) const;

    Programs& programs_;
    uint code_bits_, passes_, group_size_, most_keys_, units_;
    uint tile_ = 0;
    cl::Kernel count_, sweep_;
    uint epoch_ = 0;  ///< of the last pass
    uint turn_ = 0;   ///< which of the counters are next
    std::array<Buffer<uint>, 2>
        counters_;          ///< a row of digits a pass, then the tiles taken in each pass
    Buffer<ulong> states_;  ///< a row of digits a tile: look_back.clh
};

}  // namespace bvhbench
