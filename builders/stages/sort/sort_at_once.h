// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// All passes of a radix sort in one launch whose groups wait for each other between them: of so few pairs that a group
/// has one tile and that all groups run at the same time, for which there may be no more than compute units. Where groups
/// cannot wait, a single one. Digits have eight bits.
class SortAtOnce {
public:
    /// `group_size` work-items, a power of two from 32 (from 16 where a team is one work-item) to 512, take up to
    /// `most_keys` pairs each.
    SortAtOnce(Programs& programs, unsigned code_bits, uint group_size, uint most_keys);

    /// Whether `size` pairs are few enough.
    bool takes(std::size_t size) const;

    void plan(Arena& arena, std::size_t size);

    /// Write down what `enqueue` expects and leaves as it was. Waits.
    void prepare(const cl::CommandQueue& queue);

    /// Sort the first `count` from codes[0], with ids 0, 1, 2, …. Codes end in the buffer that the number of
    /// passes leads to, ids in `result`, by way of `other`. Does not wait.
    void enqueue(const std::array<Buffer<uint>, 2>& codes, const Buffer<uint>& result,
                 const Buffer<uint>& other, uint count, Queue& queue);

private:
    Programs& programs_;
    uint code_bits_, passes_, group_size_, most_keys_, most_tiles_;
    uint tile_ = 0;
    cl::Kernel sort_;
    uint epoch_ = 1;        ///< of the next pass
    Buffer<ulong> states_;  ///< a row of digits a tile, then a word a tile
};

}  // namespace bvhbench
