// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "builders/stages/sort/word_passes.h"
#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// Bits per pass of the group sorts; a compile-time constant of the kernels.
inline constexpr uint tile_digit_bits = 8;
inline constexpr uint most_tile_passes = 64 / tile_digit_bits;

/// A radix sort whose groups wait for each other, for devices that allow it.
///
///     sweep.cl           one launch per pass; groups wait for those of earlier tiles [Adinets2022]
///     sort_at_once.cl    all passes in one launch, in which groups wait for the pairs themselves. Each group has one tile, and all groups
///                        must be resident at the same time, so there are at most as many as compute units (one group where
///                        groups cannot wait).
class WaitingSort {
public:
    /// A group of `group_size` work-items, a power of two from 32 (from 16 if LANES is 1) to 512, takes `keys` pairs per
    /// work-item. Pairs are sorted in a single launch if they are so few that no work-item takes more than `most_keys_at_once` of
    /// them; never if that is 0.
    WaitingSort(Programs& programs, unsigned code_bits, uint group_size, uint keys,
                uint most_keys_at_once);

    /// Takes the buffers for `size` pairs. Without `keeps_codes`, passes of a launch each move words of 64 bits, and then of 32, as soon
    /// as an id and the digits of the code that are left fit into one (sweep_words.cl).
    void plan(Arena& arena, std::size_t size, bool keeps_codes);

    /// Returns a kernel for the planned sort at once that begins with what comes before the sort, compiled with `defines` in
    /// addition.
    cl::Kernel beginning_with(const char* path, const char* name,
                              std::span<const Define> defines) const;

    /// Enqueues such a kernel. Its arguments from `next` on are those of sort_at_once. `moved_bytes` is what it moves before the sort.
    void enqueue_beginning(cl::Kernel& kernel, cl_uint next,
                           const std::array<Buffer<uint>, 2>& codes, const Buffer<uint>& result,
                           std::int64_t moved_bytes, Queue& queue);

    /// Uploads the constant inputs of `enqueue`. Blocks until done.
    void prepare(const cl::CommandQueue& queue);

    /// True if passes move words, at first of 64 bits: the two buffers of `enqueue` need room for these, and no other ids are needed.
    bool sorts_words() const { return !keeps_codes_ && !is_at_once_; }

    /// True if all passes of the planned sort are in one launch.
    bool is_at_once() const { return is_at_once_; }
    /// True if the planned sort can do without its count of digits.
    bool takes_counts() const { return !is_at_once_; }
    /// Where the counts of the next sort belong, a row of digits per pass; all zero before.
    const Buffer<uint>& counters() const { return counters_[turn_]; }

    /// Sorts the first `count` codes of `unsorted`, with ids 0, 1, 2, ... Ids end in `result`. Codes, if kept, begin in codes[0], and end
    /// in codes[passes % 2], or in codes[1] if all is one launch. `other` is scratch. With `is_counted`, `counters` has the counts of the
    /// digits already. Does not block.
    void enqueue(const Buffer<uint>& unsorted, const std::array<Buffer<uint>, 2>& codes,
                 const Buffer<uint>& result, const Buffer<uint>& other, uint count, bool is_counted,
                 Queue& queue);

private:
    std::vector<Define> defines(uint keys) const;
    cl::Kernel kernel(const char* path, const char* name, uint keys) const;
    cl::Kernel word_kernel(const WordPass& pass, uint keys) const;
    uint low_passes() const { return code_words_ == 1 ? 0 : passes_ - high_passes; }
    void plan_at_once(Arena& arena, uint count);
    void plan_sweeps(Arena& arena, uint count);
    uint epochs() const;
    void next_epochs(Queue& queue);
    std::int64_t bytes_at_once(uint count) const;
    void count_digits(const Buffer<uint>& codes, uint count, Queue& queue);
    void sweep(const std::array<Buffer<uint>, 2>& codes, const Buffer<uint>& ids_a,
               const Buffer<uint>& ids_b, uint count, Queue& queue);
    void sweep_words(const Buffer<uint>& unsorted, const std::array<Buffer<uint>, 2>& words,
                     const Buffer<uint>& result, uint count, Queue& queue);

    Programs& programs_;
    uint code_bits_, code_words_, passes_, group_size_, keys_, most_keys_at_once_, units_;
    uint most_tiles_at_once_;  ///< Groups that may wait for each other.
    bool keeps_codes_ = true,
         is_at_once_ = false;  ///< True if the planned size is sorted in one launch.
    uint tile_ = 0, size_ = 0;
    cl::Kernel count_, sort_;
    std::vector<WordPass> word_passes_;
    std::vector<cl::Kernel> word_kernels_;  ///< Of each word pass.
    cl::Kernel expect_runs_,
        sort_runs_;     ///< Of codes of 64 bits: before and after the first high_passes.
    uint id_bits_ = 0;  ///< Of a word.
    uint epoch_ = 1;    ///< Epoch of the next pass.
    uint turn_ = 0;     ///< Index of the counters of the next sort.
    std::array<Buffer<uint>, 2> counters_;  ///< With a launch for each pass: see sweep_tile.clh.
    /// A row of digits per tile; in one launch twice those of tile_sums.clh, then those of order_at_once.cl.
    Buffer<ulong> states_;
    Buffer<ulong> posts_;  ///< In one launch: pairs on their way between passes (at_once.clh).
};

}  // namespace bvhbench
