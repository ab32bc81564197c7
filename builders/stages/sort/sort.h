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
    /// Chunks only: most bits per pass.
    uint chunk_digit_bits = 8;
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

/// Stage `sort`: a stable least-significant-digit radix sort of (code, id) pairs by the bits that codes have. Ids start as 0,
/// 1, 2, ..., so pairs with equal codes keep their order.
class RadixSort {
public:
    RadixSort(Programs& programs, unsigned code_bits, SortShape shape = {});

    /// Takes the buffers for `size` pairs, 0 to 2^31. Sorted ids are counted as tree memory, the rest as scratch.
    void plan(Arena& arena, std::size_t size);

    /// Uploads the constant inputs of `enqueue`. Blocks until done.
    void prepare(const cl::CommandQueue& queue);

    /// Takes the additional buffer of `enqueue_aside`.
    void plan_aside(Arena& arena);

    /// Input, code_words(code_bits) words per code; `enqueue` overwrites it.
    const Buffer<uint>& unsorted_codes() const { return codes_[0]; }

    /// Enqueues the sort of all pairs. Allocates nothing and does not block.
    void enqueue(Queue& queue);

    /// Sorts only the first `count` pairs (count >= 1). Writes the ids to `ids_aside`; the ids of an earlier sort are kept.
    void enqueue_aside(Queue& queue, uint count);

    const Buffer<uint>& ids_aside() const { return aside_; }
    const Buffer<uint>& codes() const { return codes_[passes_ % 2]; }  ///< Ascending.
    const Buffer<uint>& ids() const { return ids_[passes_ % 2]; }      ///< Ids of the sorted codes.

private:
    uint run_count(std::size_t size) const;
    void enqueue_passes(Queue& queue, uint count, const Buffer<uint>& result);
    void enqueue_pass(Queue& queue, uint pass, uint count, const Buffer<uint>& ids_in,
                      const Buffer<uint>& ids_out);

    SortShape shape_;
    uint code_bits_;
    uint digit_bits_;  ///< Of every pass; the last one may have fewer.
    uint passes_;
    std::size_t chunks_;
    cl::Kernel count_, scan_, scatter_;   ///< If groups do not wait.
    std::optional<WaitingSort> waiting_;  ///< If groups wait.
    std::size_t size_ = 0;
    std::array<Buffer<uint>, 2> codes_;  ///< Pass p reads codes_[p % 2] and writes the other.
    std::array<Buffer<uint>, 2> ids_;    ///< Pass p reads one and writes the other.
    Buffer<uint> aside_;
    Buffer<uint> counts_;  ///< A row per digit, a column per tile or chunk.
    Buffer<uint> totals_;  ///< Groups only: one per digit.
};

}  // namespace bvhbench
