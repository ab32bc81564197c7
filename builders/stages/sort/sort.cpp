// SPDX-License-Identifier: MIT
#include "builders/stages/sort/sort.h"

#include <algorithm>
#include <cassert>

#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr auto groups_path = "builders/stages/sort/sort_groups.cl";
constexpr auto chunks_path = "builders/stages/sort/sort_chunks.cl";

/// Most bits of the lower digits of chunks: a table of them fits the nearest cache.
constexpr uint most_bucket_digit_bits = 11;

/// Pairs for each work-item that sorts buckets.
constexpr uint pairs_per_item = 256;

/// Pairs of a work-item in one launch: as many as leave a tile of 512 work-items within 32 KiB of local memory.
constexpr uint keys_at_once = 16;

std::int64_t bytes(std::size_t words) { return static_cast<std::int64_t>(words * sizeof(uint)); }

}  // namespace

SortShape sort_shape(const Device& device, KernelForm form)
{
    SortShape shape{.form = chosen_form(device, form)};
    if (shape.form == KernelForm::chunks) {
        shape.chunk_digit_bits = device.tuned(sort_chunk_digit_bits);
    } else if (device.lets_groups_wait() || (device.is_cpu() && device.tuned(sort_at_once) != 0)) {
        // A CPU runs groups in order, so those that a group waits for have started. It is chosen there in tests only.
        shape.sweeps = SortShape::Sweeps::always;
        shape.sweep_group_size = device.tuned(sweep_group_size);
        shape.sweep_keys_per_item = device.tuned(sweep_keys_per_item);
        shape.keys_at_once = device.tuned(sort_at_once) != 0 ? keys_at_once : 0;
    } else {
        shape.group_size = device.tuned(sort_group_size);
    }
    return shape;
}

RadixSort::RadixSort(Programs& programs, unsigned code_bits, SortShape shape)
    : shape_(shape), code_bits_(code_bits), chunks_(chunk_count(programs.device()))
{
    shape_.form = chosen_form(programs.device(), shape.form);
    const uint words = code_words(code_bits);
    using enum SortShape::Sweeps;
    if (shape_.form == KernelForm::groups &&
        (shape.sweeps == always ||
         (shape.sweeps == of_device && programs.device().lets_groups_wait()))) {
        digit_bits_ = tile_digit_bits;
        waiting_.emplace(programs, code_bits, shape.sweep_group_size, shape.sweep_keys_per_item,
                         shape.keys_at_once / words);
    } else if (shape_.form == KernelForm::groups) {
        assert(shape.group_size >= 16 && shape.group_size <= 256);
        assert(shape.keys_per_item % 2 == 1 && shape.keys_per_item <= 15);
        // PoCL 3.1 generates crashing code if a whole group may return before a barrier.
        const auto kernel = [&](const char* name) {
            return programs.kernel(groups_path, name,
                                   {{"GROUP_SIZE", shape.group_size},
                                    {"KEYS_PER_ITEM", shape.keys_per_item},
                                    {"CODE_WORDS", words},
                                    {"DIGIT_BITS", tile_digit_bits}});
        };
        digit_bits_ = tile_digit_bits;
        count_ = kernel("count_tiles");
        scan_ = kernel("scan_digits");
        scatter_ = kernel("scatter_tiles");
    } else {
        digit_bits_ = std::min(shape.chunk_digit_bits, code_bits);
        const auto kernel = [&](const char* name) {
            return programs.kernel(chunks_path, name,
                                   {{"DIGIT_BITS", digit_bits_},
                                    {"BUCKET_DIGIT_BITS", most_bucket_digit_bits},
                                    {"CODE_WORDS", words}});
        };
        count_ = kernel("count_chunks");
        scan_ = kernel("scan_chunks");
        scatter_ = kernel("scatter_chunks");
        buckets_ = kernel("sort_buckets");
    }
    passes_ = shape_.form == KernelForm::groups
                  ? divided_up(code_bits, digit_bits_)
                  : 1 + divided_up(code_bits - digit_bits_, most_bucket_digit_bits);
}

/// Returns the bits of each lower digit of chunks.
uint RadixSort::bucket_digit_bits() const
{
    return passes_ > 1 ? divided_up(code_bits_ - digit_bits_, passes_ - 1) : 0;
}

/// Returns the number of tiles or chunks that the pairs are divided into.
uint RadixSort::run_count(std::size_t size) const
{
    const auto count = static_cast<uint>(size);
    if (shape_.form == KernelForm::groups)
        return divided_up(count, shape_.group_size * shape_.keys_per_item);
    return std::min(divided_up(count, shape_.pairs_per_chunk), static_cast<uint>(chunks_));
}

void RadixSort::plan(Arena& arena, std::size_t size, bool keeps_codes)
{
    size_ = size;
    const std::size_t words = size * code_words(code_bits_);
    if (waiting_)
        waiting_->plan(arena, size, keeps_codes);
    moves_words_ = waiting_ && waiting_->sorts_words();
    if (moves_words_) {
        ids_[passes_ % 2] = {arena.take_twice<uint>(size).cl(), size};
        ids_[(passes_ + 1) % 2] = {arena.take<uint>(2 * size, Use::scratch).cl(), size};
        codes_ = ids_;
        unsorted_ = code_words(code_bits_) == 1 ? codes_[0] : arena.take<uint>(words, Use::scratch);
        return;
    }
    ids_[passes_ % 2] = arena.take<uint>(size, Use::tree);
    ids_[(passes_ + 1) % 2] = arena.take<uint>(size, Use::scratch);
    for (Buffer<uint>& codes : codes_)
        codes = arena.take<uint>(words, Use::scratch);
    unsorted_ = codes_[0];
    if (waiting_)
        return;
    const std::size_t digits = std::size_t{1} << std::max(digit_bits_, bucket_digit_bits());
    counts_ = arena.take<uint>(digits * run_count(size), Use::scratch);
    totals_ = arena.take<uint>(shape_.form == KernelForm::groups ? digits : 0, Use::scratch);
    const bool has_buckets =
        shape_.form == KernelForm::chunks && passes_ > 1 && size > shape_.few_pairs;
    largest_ = arena.take<uint>(shape_.form == KernelForm::chunks ? 2 : 0, Use::scratch);
    more_counts_ = arena.take<uint>(
        has_buckets ? (std::size_t{1} << bucket_digit_bits()) * run_count(size) : 0, Use::scratch);
}

void RadixSort::prepare(const cl::CommandQueue& queue)
{
    if (waiting_)
        waiting_->prepare(queue);
}

void RadixSort::plan_aside(Arena& arena)
{
    aside_ = {arena.take<uint>(moves_words_ ? 2 * size_ : size_, Use::scratch).cl(), size_};
}

void RadixSort::enqueue(Queue& queue, bool is_counted)
{
    queue.begin("sort");
    enqueue_passes(queue, static_cast<uint>(size_), unsorted_, codes_, ids(), is_counted);
}

void RadixSort::enqueue_in_stage(Queue& queue)
{
    enqueue_passes(queue, static_cast<uint>(size_), unsorted_, codes_, ids(), false);
}

void RadixSort::enqueue_aside(Queue& queue, uint count)
{
    assert(count > 0 && count <= aside_.size());
    std::array<Buffer<uint>, 2> codes = codes_;
    if (moves_words_)
        codes[passes_ % 2] = aside_;
    queue.begin("sort");
    enqueue_passes(queue, count, unsorted_codes_aside(), codes, aside_, false);
}

void RadixSort::enqueue_passes(Queue& queue, uint count, const Buffer<uint>& unsorted,
                               const std::array<Buffer<uint>, 2>& codes, const Buffer<uint>& result,
                               bool is_counted)
{
    if (count == 0)
        return;
    const Buffer<uint>& other = ids_[(passes_ + 1) % 2];
    if (waiting_) {
        waiting_->enqueue(unsorted, codes, result, other, count, is_counted, queue);
        return;
    }
    if (shape_.form == KernelForm::chunks) {
        const bool is_odd = passes_ % 2 == 1;
        enqueue_chunks(queue, count, is_odd ? result : other, is_odd ? other : result);
        return;
    }
    for (uint pass = 0; pass < passes_; ++pass) {
        const bool to_result = (passes_ - pass) % 2 == 1;
        enqueue_pass(queue, pass, count, to_result ? other : result, to_result ? result : other);
    }
}

void RadixSort::enqueue_pass(Queue& queue, uint pass, uint count, const Buffer<uint>& ids_in,
                             const Buffer<uint>& ids_out)
{
    const uint runs = run_count(count);
    const uint shift = pass * digit_bits_;
    const uint mask = (1u << std::min(digit_bits_, code_bits_ - shift)) - 1;
    const uint is_first = pass == 0 ? 1 : 0;
    const Buffer<uint>& codes_in = codes_[pass % 2];
    const Buffer<uint>& codes_out = codes_[(pass + 1) % 2];

    const std::size_t table = (std::size_t{mask} + 1) * runs;
    const std::size_t words = std::size_t{count} * code_words(code_bits_);
    const std::int64_t count_bytes = bytes(words + table);
    const std::int64_t scan_bytes = bytes(2 * table);
    const std::int64_t scatter_bytes =
        bytes(2 * words + (2 - is_first) * std::size_t{count} + table);

    set_arguments(count_, codes_in, counts_, count, shift, mask);
    set_arguments(scan_, counts_, totals_, runs);
    set_arguments(scatter_, codes_in, ids_in, codes_out, ids_out, counts_, totals_, count, shift,
                  mask, is_first);
    const std::size_t group = shape_.group_size;
    queue.launch(count_, runs * group, group, count_bytes);
    queue.launch(scan_, (mask + 1) * group, group, scan_bytes);
    queue.launch(scatter_, runs * group, group, scatter_bytes);
}

/// Enqueues the sort in chunks. The first pass moves pairs to `ids`, and each pass from one of the two to the other.
void RadixSort::enqueue_chunks(Queue& queue, uint count, const Buffer<uint>& ids,
                               const Buffer<uint>& other_ids)
{
    if (count <= shape_.few_pairs) {
        const uint bits = divided_up(code_bits_, passes_);
        for (uint pass = 0; pass < passes_; ++pass)
            enqueue_move(queue, count, pass, pass * bits, bits, Moved::all,
                         pass % 2 == 0 ? other_ids : ids, pass % 2 == 0 ? ids : other_ids);
        return;
    }
    enqueue_move(queue, count, 0, code_bits_ - digit_bits_, digit_bits_, Moved::all, other_ids,
                 ids);
    if (passes_ == 1)
        return;
    const uint bits = bucket_digit_bits();
    enqueue_move(queue, count, 1, (passes_ - 2) * bits, bits, Moved::largest_bucket, ids,
                 other_ids);
    const uint mask = (1u << digit_bits_) - 1, more_mask = (1u << bits) - 1;
    set_arguments(buckets_, codes_[1], ids, codes_[0], other_ids, counts_, more_counts_, largest_,
                  count, mask, more_mask, passes_ - 1, bits);
    const std::size_t words = std::size_t{count} * (code_words(code_bits_) + 1);
    queue.launch(buckets_,
                 std::min(std::max(mask, more_mask) + 1, divided_up(count, pairs_per_item)), 1,
                 bytes(2 * words));
}

/// Enqueues a move of all pairs, or of those of the largest bucket, by the digit of `bits` bits from `shift` on.
void RadixSort::enqueue_move(Queue& queue, uint count, uint pass, uint shift, uint bits,
                             Moved moved, const Buffer<uint>& ids_in, const Buffer<uint>& ids_out)
{
    const uint runs = run_count(count);
    const uint mask = (1u << bits) - 1, is_second = moved == Moved::largest_bucket ? 1 : 0;
    const uint most = std::max(shape_.large_bucket, 2 * divided_up(count, runs));
    const Buffer<uint>& counts = is_second != 0 ? more_counts_ : counts_;
    const Buffer<uint>& codes_in = codes_[pass % 2];
    const Buffer<uint>& codes_out = codes_[(pass + 1) % 2];
    set_arguments(count_, codes_in, counts, largest_, count, shift, mask, is_second);
    set_arguments(scan_, counts, largest_, runs, mask, most, is_second);
    set_arguments(scatter_, codes_in, ids_in, codes_out, ids_out, counts, largest_, count, shift,
                  mask, is_second, pass == 0 ? 1u : 0u);
    const std::size_t table = (std::size_t{mask} + 1) * runs;
    const std::size_t pairs = is_second != 0 ? 0 : count;  // of the largest bucket: unknown
    const std::size_t words = pairs * code_words(code_bits_);
    queue.launch(count_, runs, 1, bytes(words + table));
    queue.launch(scan_, 1, 1, bytes(2 * table));
    queue.launch(scatter_, runs, 1, bytes(2 * words + (pass == 0 ? 1 : 2) * pairs + table));
}

}  // namespace bvhbench
