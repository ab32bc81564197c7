// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// Bits per pass of the group sorts; a compile-time constant of the kernels.
inline constexpr uint tile_digit_bits = 8;

/// A radix sort whose groups wait for each other, for devices that allow it.
///
///     sweep.cl           one launch per pass; groups wait for those of earlier tiles [Adinets2022]
///     sort_at_once.cl    all passes in one launch with device-wide barriers in between. Each group has one tile, and all groups
///                        must be resident at the same time, so there are at most as many as compute units (one group where
///                        groups cannot wait).
class WaitingSort {
public:
    /// A group of `group_size` work-items, a power of two from 32 (from 16 if LANES is 1) to 512, takes `keys` pairs per
    /// work-item. Pairs are sorted in a single launch if they are so few that no work-item takes more than `most_keys_at_once` of
    /// them; never if that is 0.
    WaitingSort(Programs& programs, unsigned code_bits, uint group_size, uint keys,
                uint most_keys_at_once);

    void plan(Arena& arena, std::size_t size);

    /// Uploads the constant inputs of `enqueue`. Blocks until done.
    void prepare(const cl::CommandQueue& queue);

    /// Sorts the first `count` codes of codes[0], with ids 0, 1, 2, ... Codes end in codes[passes % 2], ids in `result`;
    /// `other` is scratch. Does not block.
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
    uint code_bits_, code_words_, passes_, group_size_, keys_, most_keys_at_once_, units_;
    uint most_tiles_at_once_;  ///< Groups that may wait for each other.
    bool is_at_once_ = false;  ///< True if the planned size is sorted in one launch.
    uint tile_ = 0;
    cl::Kernel count_, sort_;
    uint epoch_ = 1;  ///< Epoch of the next pass.
    uint turn_ = 0;   ///< Index of the counters of the next sort.
    std::array<Buffer<uint>, 2>
        counters_;  ///< sweep.cl only: a row of digits per pass, then the tiles taken in each pass.
    Buffer<ulong>
        states_;  ///< A row of digits per tile; in one launch those of tile_sums.clh, then a word per tile.
};

}  // namespace bvhbench
