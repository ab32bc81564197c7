// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// Bits that a pass of the sorts by groups sorts by, which kernels are compiled with.
inline constexpr uint tile_digit_bits = 8;

/// A radix sort whose groups wait for each other, for devices that let them.
///
///     sweep.cl           a launch a pass, in which groups wait for those before them [Adinets2022]
///     sort_at_once.cl    all passes in one launch, between which groups wait for all: of so few pairs that a group has one
///                        tile and that all groups run at the same time, for which there may be no more than compute
///                        units. Where groups cannot wait, a single one.
class WaitingSort {
public:
    /// `group_size` work-items, a power of two from 32 (from 16 where a team is one work-item) to 512, take
    /// `most_keys` pairs each, or fewer of few pairs. `at_once` says whether few pairs are sorted in one launch.
    WaitingSort(Programs& programs, unsigned code_bits, uint group_size, uint most_keys,
                bool at_once);

    void plan(Arena& arena, std::size_t size);

    /// Write down what `enqueue` expects and leaves as it was. Waits.
    void prepare(const cl::CommandQueue& queue);

    /// Sort the first `count` from codes[0], with ids 0, 1, 2, …. Codes end in the buffer that the number of
    /// passes leads to, ids in `result`, by way of `other`. Does not wait.
    void enqueue(const std::array<Buffer<uint>, 2>& codes, const Buffer<uint>& result,
                 const Buffer<uint>& other, uint count, Queue& queue);

private:
    cl::Kernel kernel(const char* path, const char* name, uint keys) const;
    void plan_at_once(Arena& arena, uint count);
    void plan_sweeps(Arena& arena, uint count);
    void sort_at_once(const std::array<Buffer<uint>, 2>& codes, const Buffer<uint>& ids_a,
                      const Buffer<uint>& ids_b, uint count, Queue& queue);
    void sweep(const std::array<Buffer<uint>, 2>& codes, const Buffer<uint>& ids_a,
               const Buffer<uint>& ids_b, uint count, Queue& queue);

    Programs& programs_;
    uint code_bits_, code_words_, passes_, group_size_, most_keys_, units_;
    uint most_tiles_at_once_;  ///< 0: never
    bool is_at_once_ = false;  ///< as planned
    uint tile_ = 0;
    cl::Kernel count_, sort_;
    uint epoch_ = 1;  ///< of the next pass
    uint turn_ = 0;   ///< which of the counters are next
    std::array<Buffer<uint>, 2>
        counters_;  ///< sweeps only: a row of digits a pass, then the tiles taken in each pass
    Buffer<ulong>
        states_;  ///< a row of digits a tile (look_back.clh); at once, behind them a word a tile
};

}  // namespace bvhbench
