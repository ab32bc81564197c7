// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "builders/stages/codes.h"
#include "builders/stages/kernel_form.h"
#include "builders/stages/sort/waiting_sort.h"

namespace bvhbench {

/// Launch parameters of the sort. `sort_shape` returns those of a device; other values are for tests.
struct SortShape {
    KernelForm form = KernelForm::of_device;
    /// Groups that do not wait: work-items per group, a power of two from 16 to 256.
    uint group_size = 256;
    /// Groups that do not wait: pairs per work-item, odd and at most 15. A tile has group_size * keys_per_item pairs.
    uint keys_per_item = 15;
    /// Chunks only: bits of the highest digit, which moves pairs to buckets (sort_chunks.cl).
    uint chunk_digit_bits = 10;
    /// Chunks only: pairs for each chunk, at most as many as there are; with fewer, counting digits takes longer than moving pairs.
    uint pairs_per_chunk = 1024;
    /// Chunks only: most pairs that are moved by each digit, the lowest first.
    uint few_pairs = 1u << 18;
    /// Chunks only: pairs above which the largest bucket is split once more.
    uint large_bucket = 1u << 14;
    /// Groups only: whether groups wait for each other, so that a pass is one launch; and their parameters if they do.
    enum class Sweeps { of_device, never, always } sweeps = Sweeps::of_device;
    uint sweep_group_size = 512;
    uint sweep_keys_per_item = 8;  ///< Codes of two words: half as many.
    /// Groups that wait only: most pairs per work-item that are sorted in one launch (see WaitingSort), of codes of two words half
    /// as many; 0: none are.
    uint keys_at_once = 0;
};

/// Returns the tuned parameters of `device`.
SortShape sort_shape(const Device& device, KernelForm form = KernelForm::of_device);

/// Stage `sort`: a stable radix sort of (code, id) pairs by the bits that codes have, by the lowest digit first, or in chunks by the
/// highest and then the lowest. Ids start as 0, 1, 2, ..., so pairs with equal codes keep their order.
class RadixSort {
public:
    RadixSort(Programs& programs, unsigned code_bits, SortShape shape = {});

    /// Takes the buffers for `size` pairs, 0 to 2^31. Sorted ids are counted as tree memory, the rest as scratch. Without
    /// `keeps_codes`, `codes` is undefined, and passes may move fewer bytes.
    void plan(Arena& arena, std::size_t size, bool keeps_codes = true);

    /// Uploads the constant inputs of `enqueue`. Blocks until done.
    void prepare(const cl::CommandQueue& queue);

    /// Takes the additional buffer of `enqueue_aside`.
    void plan_aside(Arena& arena);

    /// Input, code_words(code_bits) words per code; `enqueue` overwrites it. It may share memory with `ids`.
    const Buffer<uint>& unsorted_codes() const { return unsorted_; }
    /// Input of `enqueue_aside`, which overwrites it.
    const Buffer<uint>& unsorted_codes_aside() const
    {
        return moves_words_ && passes_ % 2 == 0 && code_words(code_bits_) == 1 ? aside_ : unsorted_;
    }

    /// True if the planned sort needs the counts of all digits, so that who makes the codes may count them.
    bool takes_counts() const { return waiting_ && waiting_->takes_counts(); }
    /// If it does: where the counts for the next `enqueue` belong, a row of digits per pass (digit_counts.clh); all zero before.
    const Buffer<uint>& counters() const { return waiting_->counters(); }
    uint code_bits() const { return code_bits_; }

    /// True if the planned sort is one launch, which may begin with what comes before it.
    bool is_at_once() const { return waiting_ && waiting_->is_at_once(); }
    /// The kernel of such a launch (WaitingSort::beginning_with).
    cl::Kernel beginning_with(const char* path, const char* name,
                              std::span<const Define> defines) const
    {
        return waiting_->beginning_with(path, name, defines);
    }
    /// Enqueues such a launch (WaitingSort::enqueue_beginning).
    void enqueue_beginning(cl::Kernel& kernel, cl_uint next, std::int64_t moved_bytes, Queue& queue)
    {
        waiting_->enqueue_beginning(kernel, next, codes_, ids(), moved_bytes, queue);
    }

    /// Enqueues the sort of all pairs. With `is_counted`, `counters` has the counts. Allocates nothing and does not block.
    void enqueue(Queue& queue, bool is_counted = false);

    /// As `enqueue`, in the current stage.
    void enqueue_in_stage(Queue& queue);

    /// Sorts only the first `count` pairs (count >= 1). Writes the ids to `ids_aside`; the ids of an earlier sort are kept.
    void enqueue_aside(Queue& queue, uint count);

    const Buffer<uint>& ids_aside() const { return aside_; }
    const Buffer<uint>& codes() const  ///< Ascending.
    {
        return codes_[is_at_once() ? 1 : passes_ % 2];
    }
    const Buffer<uint>& ids() const { return ids_[passes_ % 2]; }  ///< Ids of the sorted codes.

private:
    uint run_count(std::size_t size) const;
    void enqueue_passes(Queue& queue, uint count, const Buffer<uint>& unsorted,
                        const std::array<Buffer<uint>, 2>& codes, const Buffer<uint>& result,
                        bool is_counted);
    void enqueue_pass(Queue& queue, uint pass, uint count, const Buffer<uint>& ids_in,
                      const Buffer<uint>& ids_out);
    void enqueue_chunks(Queue& queue, uint count, const Buffer<uint>& ids,
                        const Buffer<uint>& other_ids);
    enum class Moved { all, largest_bucket };
    void enqueue_move(Queue& queue, uint count, uint pass, uint shift, uint bits, Moved moved,
                      const Buffer<uint>& ids_in, const Buffer<uint>& ids_out);
    uint bucket_digit_bits() const;

    SortShape shape_;
    uint code_bits_;
    /// Of every pass of groups, the last one may have fewer; of the highest digit of chunks.
    uint digit_bits_;
    uint passes_;
    std::size_t chunks_;
    cl::Kernel count_, scan_, scatter_;   ///< If groups do not wait.
    cl::Kernel buckets_;                  ///< Chunks only.
    std::optional<WaitingSort> waiting_;  ///< If groups wait.
    std::size_t size_ = 0;
    Buffer<uint> unsorted_;
    /// True if passes move words of 64 bits. Then codes_ and ids_ are the same two buffers, with room for such words, and codes of 64 bits
    /// begin in a third.
    bool moves_words_ = false;
    std::array<Buffer<uint>, 2> codes_;  ///< Pass p reads codes_[p % 2] and writes the other.
    std::array<Buffer<uint>, 2> ids_;    ///< Pass p reads one and writes the other.
    Buffer<uint> aside_;
    Buffer<uint> counts_;       ///< A row per digit, a column per tile; or a row per chunk.
    Buffer<uint> totals_;       ///< Groups only: one per digit.
    Buffer<uint> more_counts_;  ///< Chunks only: of the largest bucket.
    Buffer<uint> largest_;      ///< Chunks only: the largest bucket's first pair and end.
};

}  // namespace bvhbench
