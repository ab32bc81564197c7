// SPDX-License-Identifier: MIT
#include "builders/stages/sort.h"

#include <algorithm>
#include <cassert>

#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr auto groups_path = "builders/stages/sort_groups.cl";
constexpr auto chunks_path = "builders/stages/sort_chunks.cl";
constexpr uint group_digit_bits = 8;  // two rounds of sort_tile

std::int64_t bytes(std::size_t words) { return static_cast<std::int64_t>(words * sizeof(uint)); }

}  // namespace

RadixSort::RadixSort(Programs& programs, unsigned code_bits, SortShape shape)
    : shape_(shape), code_bits_(code_bits), chunks_(chunk_count(programs.device()))
{
    shape_.form = chosen_form(programs.device(), shape.form);
    const uint words = code_words(code_bits);
    using enum SortShape::Sweeps;
    if (shape_.form == KernelForm::groups &&
        (shape.sweeps == always ||
         (shape.sweeps == of_device && programs.device().lets_groups_wait()))) {
        digit_bits_ = group_digit_bits;
        sweeps_.emplace(programs, code_bits, shape.sweep_group_size,
                        std::max(1u, shape.sweep_keys_per_item / words));
    } else if (shape_.form == KernelForm::groups) {
        assert(shape.group_size >= 16 && shape.group_size <= 256);
        assert(shape.keys_per_item % 2 == 1 && shape.keys_per_item <= 15);
        const auto kernel = [&](const char* name) {
            return programs.kernel(groups_path, name,
                                   {{"GROUP_SIZE", shape.group_size},
                                    {"KEYS_PER_ITEM", shape.keys_per_item},
                                    {"CODE_WORDS", words}});
        };
        digit_bits_ = group_digit_bits;
        count_ = kernel("count_tiles");
        scan_ = kernel("scan_digits");
        scatter_ = kernel("scatter_tiles");
    } else {
        const auto kernel = [&](const char* name) {
            return programs.kernel(chunks_path, name,
                                   {{"DIGIT_BITS", shape.chunk_digit_bits}, {"CODE_WORDS", words}});
        };
        digit_bits_ = shape.chunk_digit_bits;
        count_ = kernel("count_chunks");
        scan_ = kernel("scan_chunks");
        scatter_ = kernel("scatter_chunks");
    }
    passes_ = divided_up(code_bits, digit_bits_);
}

/// Tiles or chunks the pairs are cut into.
uint RadixSort::run_count() const
{
    const auto size = static_cast<uint>(size_);
    if (shape_.form == KernelForm::groups)
        return divided_up(size, shape_.group_size * shape_.keys_per_item);
    return std::min(size, static_cast<uint>(chunks_));
}

void RadixSort::plan(Arena& arena, std::size_t size)
{
    size_ = size;
    const std::size_t words = size * code_words(code_bits_);
    const std::size_t digits = std::size_t{1} << digit_bits_;
    ids_[passes_ % 2] = arena.take<uint>(size, Use::tree);
    ids_[(passes_ + 1) % 2] = arena.take<uint>(size, Use::scratch);
    for (Buffer<uint>& codes : codes_)
        codes = arena.take<uint>(words, Use::scratch);
    if (sweeps_) {
        sweeps_->plan(arena, size);
        return;
    }
    counts_ = arena.take<uint>(digits * run_count(), Use::scratch);
    totals_ = arena.take<uint>(digits, Use::scratch);
}

void RadixSort::prepare(const cl::CommandQueue& queue)
{
    if (sweeps_)
        sweeps_->prepare(queue);
}

void RadixSort::enqueue(Queue& queue)
{
    queue.begin("sort");
    if (sweeps_ && size_ > 0)
        sweeps_->enqueue(codes_, ids_, queue);
    else if (size_ > 0)
        for (uint pass = 0; pass < passes_; ++pass)
            enqueue_pass(queue, pass);
}

void RadixSort::enqueue_pass(Queue& queue, uint pass)
{
    const auto size = static_cast<uint>(size_);
    const uint runs = run_count();
    const uint shift = pass * digit_bits_;
    const uint mask = (1u << std::min(digit_bits_, code_bits_ - shift)) - 1;
    const uint is_first = pass == 0 ? 1 : 0;
    const Buffer<uint>& codes_in = codes_[pass % 2];
    const Buffer<uint>& codes_out = codes_[(pass + 1) % 2];
    const Buffer<uint>& ids_in = ids_[pass % 2];
    const Buffer<uint>& ids_out = ids_[(pass + 1) % 2];

    const std::size_t table = (std::size_t{mask} + 1) * runs;
    const std::int64_t count_bytes = codes_in.bytes() + bytes(table);
    const std::int64_t scan_bytes = bytes(2 * table);
    const std::int64_t scatter_bytes = bytes(2 * codes_in.size() + (2 - is_first) * size_ + table);

    set_arguments(count_, codes_in, counts_, size, shift, mask);
    if (shape_.form == KernelForm::groups) {
        set_arguments(scan_, counts_, totals_, runs);
        set_arguments(scatter_, codes_in, ids_in, codes_out, ids_out, counts_, totals_, size, shift,
                      mask, is_first);
        const std::size_t group = shape_.group_size;
        queue.launch(count_, runs * group, group, count_bytes);
        queue.launch(scan_, (mask + 1) * group, group, scan_bytes);
        queue.launch(scatter_, runs * group, group, scatter_bytes);
    } else {
        set_arguments(scan_, counts_, static_cast<uint>(table));
        set_arguments(scatter_, codes_in, ids_in, codes_out, ids_out, counts_, size, shift, mask,
                      is_first);
        queue.launch(count_, runs, 1, count_bytes);
        queue.launch(scan_, 1, 1, scan_bytes);
        queue.launch(scatter_, runs, 1, scatter_bytes);
    }
}

}  // namespace bvhbench
