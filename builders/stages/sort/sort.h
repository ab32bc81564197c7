// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "builders/stages/codes.h"
#include "builders/stages/kernel_form.h"
#include "builders/stages/sort/waiting_sort.h"

namespace bvhbench {

/// How the sort is cut up. `sort_shape` says how on a device; other values are for tests.
struct SortShape {
    KernelForm form = KernelForm::of_device;
    /// Groups only: work-items in a group, a power of two from 16 to 256.
    uint group_size = 256;
    /// Groups only: pairs a work-item ranks, odd and at most 15. A tile is group_size times as many.
    uint keys_per_item = 15;
    /// Chunks only: bits a pass sorts by at most.
    uint chunk_digit_bits = 8;
    /// Groups only: whether they wait for each other, so that a pass is one launch, and their shape if they do.
    enum class Sweeps { of_device, never, always } sweeps = Sweeps::of_device;
    uint sweep_group_size = 512;
    uint sweep_keys_per_item = 8;  ///< codes of two words: half as many
    /// Groups that wait only: whether few pairs are sorted in one launch.
    bool at_once = false;
};

/// As the device is tuned.
SortShape sort_shape(const Device& device, KernelForm form = KernelForm::of_device);

/// The stage `sort`: a stable radix sort of (code, id) pairs, least significant digit first, by only the bits
/// that codes have. Ids start as 0, 1, 2, …, so equal codes keep the order they came in.
class RadixSort {
public:
    RadixSort(Programs& programs, unsigned code_bits, SortShape shape = {});

    /// Take the buffers for `size` pairs, 0 to 2^31. The sorted ids are tree memory, the rest is scratch.
    void plan(Arena& arena, std::size_t size);

    /// Write down what `enqueue` expects and leaves as it was. Waits.
    void prepare(const cl::CommandQueue& queue);

    /// Take one more, for `enqueue_aside`.
    void plan_aside(Arena& arena);

    /// To be filled before enqueue, which overwrites it: code_words(code_bits) words a code.
    const Buffer<uint>& unsorted_codes() const { return codes_[0]; }

    /// Enqueue the sort. Allocates nothing and does not wait.
    void enqueue(Queue& queue);

    /// The same of the first `count` pairs only, at least one. Their ids go to `ids_aside` and leave those of an
    /// earlier sort as they are.
    void enqueue_aside(Queue& queue, uint count);

    const Buffer<uint>& ids_aside() const { return aside_; }
    const Buffer<uint>& codes() const { return codes_[passes_ % 2]; }  ///< ascending
    const Buffer<uint>& ids() const { return ids_[passes_ % 2]; }      ///< of the sorted codes

private:
    uint run_count(std::size_t size) const;
    void enqueue_passes(Queue& queue, uint count, const Buffer<uint>& result);
    void enqueue_pass(Queue& queue, uint pass, uint count, const Buffer<uint>& ids_in,
                      const Buffer<uint>& ids_out);

    SortShape shape_;
    uint code_bits_;
    uint digit_bits_;  ///< of every pass but perhaps the last
    uint passes_;
    std::size_t chunks_;
    cl::Kernel count_, scan_, scatter_;   ///< unless groups wait
    std::optional<WaitingSort> waiting_;  ///< if they do
    std::size_t size_ = 0;
    std::array<Buffer<uint>, 2> codes_;  ///< pass p goes from [p % 2] to the other
    std::array<Buffer<uint>, 2> ids_;    ///< pass p reads one and writes the other
    Buffer<uint> aside_;
    Buffer<uint> counts_;  ///< a row a digit, a column a tile or chunk
    Buffer<uint> totals_;  ///< groups only: one a digit
};

}  // namespace bvhbench
