// SPDX-License-Identifier: MIT
#include "builders/stages/sort/waiting_sort.h"

#include <algorithm>
#include <cassert>

#include "builders/parameters.h"
#include "builders/stages/codes.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr uint digits = 1u << tile_digit_bits;
constexpr uint most_passes = 64 / tile_digit_bits;

/// Bits of the epoch in a look-back state (look_back.clh). Epoch 0 is that of cleared states.
constexpr uint state_epoch_bits = 31;
constexpr uint last_epoch = (1u << state_epoch_bits) - 1;

constexpr std::size_t counting_groups_per_unit = 2;  ///< that count digits

/// Fewest keys per work-item in one launch: with fewer, there are more groups, and they wait longer for each other.
constexpr uint fewest_keys = 4;

/// Most tiles whose counts each group reads itself (tile_sums.clh).
constexpr uint few_tiles = 16;

}  // namespace

WaitingSort::WaitingSort(Programs& programs, unsigned code_bits, uint group_size, uint keys,
                         uint most_keys_at_once)
    : programs_(programs)
    , code_bits_(code_bits)
    , code_words_(code_words(code_bits))
    , passes_(divided_up(code_bits, tile_digit_bits))
    , group_size_(group_size)
    , keys_(keys)
    , most_keys_at_once_(most_keys_at_once)
    , units_(programs.device().cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>())
    , most_tiles_at_once_(programs.device().lets_groups_wait() ? units_ : 1)
{
    assert(group_size >= 16 && group_size <= 512);
}

cl::Kernel WaitingSort::kernel(const char* path, const char* name, uint keys) const
{
    return programs_.kernel(path, name,
                            {{"GROUP_SIZE", group_size_},
                             {"KEYS_PER_ITEM", keys},
                             {"CODE_WORDS", code_words_},
                             {"DIGIT_BITS", tile_digit_bits},
                             {"MOST_PASSES", most_passes},
                             {"MOST_TILES", most_tiles_at_once_},
                             {"FEW_TILES", few_tiles},
                             {"STATE_EPOCH_BITS", state_epoch_bits}},
                            Optimise::on_gpus);
}

void WaitingSort::plan(Arena& arena, std::size_t size)
{
    epoch_ = 1;
    turn_ = 0;
    is_at_once_ = size <= std::size_t{most_tiles_at_once_} * group_size_ * most_keys_at_once_;
    const auto count = static_cast<uint>(size);
    if (is_at_once_)
        plan_at_once(arena, count);
    else
        plan_sweeps(arena, count);
}

void WaitingSort::plan_at_once(Arena& arena, uint count)
{
    const uint needed = divided_up(count, group_size_ * most_tiles_at_once_);
    const uint keys = std::min(most_keys_at_once_, std::max(fewest_keys, needed));
    tile_ = group_size_ * keys;
    sort_ = kernel("builders/stages/sort/sort_at_once.cl", "sort_at_once", keys);
    counters_ = {};
    const std::size_t tiles = divided_up(count, tile_);
    states_ = arena.take<ulong>(tiles * (2 * digits + 1) + digits, Use::scratch);
}

void WaitingSort::plan_sweeps(Arena& arena, uint count)
{
    tile_ = group_size_ * keys_;
    count_ = kernel("builders/stages/sort/sweep.cl", "count_digits", keys_);
    sort_ = kernel("builders/stages/sort/sweep.cl", "sweep", keys_);
    for (Buffer<uint>& counters : counters_)
        counters = arena.take<uint>(most_passes * (digits + 1), Use::scratch);
    states_ = arena.take<ulong>(std::size_t{divided_up(count, tile_)} * digits, Use::scratch);
}

void WaitingSort::prepare(const cl::CommandQueue& queue)
{
    if (states_.size() == 0)
        return;
    queue.enqueueFillBuffer(states_.cl(), cl_uint{0}, 0, states_.bytes());
    for (const Buffer<uint>& counters : counters_)
        if (counters.size() > 0)
            queue.enqueueFillBuffer(counters.cl(), cl_uint{0}, 0, counters.bytes());
    queue.finish();
}

void WaitingSort::enqueue(const std::array<Buffer<uint>, 2>& codes, const Buffer<uint>& result,
                          const Buffer<uint>& other, uint count, Queue& queue)
{
    if (epoch_ > last_epoch - passes_) {
        queue.clear(states_.cl(), states_.bytes());
        epoch_ = 1;
    }
    const bool is_odd = passes_ % 2 == 1;  // the last pass writes ids to `result`
    const Buffer<uint>& ids_a = is_odd ? other : result;
    const Buffer<uint>& ids_b = is_odd ? result : other;
    if (is_at_once_)
        sort_at_once(codes, ids_a, ids_b, count, queue);
    else
        sweep(codes, ids_a, ids_b, count, queue);
    epoch_ += passes_;
}

void WaitingSort::sort_at_once(const std::array<Buffer<uint>, 2>& codes, const Buffer<uint>& ids_a,
                               const Buffer<uint>& ids_b, uint count, Queue& queue)
{
    const std::int64_t id_bytes = std::int64_t{count} * sizeof(uint);
    const std::int64_t code_bytes = id_bytes * code_words_;
    set_arguments(sort_, codes[0], ids_a, codes[1], ids_b, states_, count, passes_, epoch_);
    queue.launch(sort_, std::size_t{divided_up(count, tile_)} * group_size_, group_size_,
                 passes_ * 2 * (code_bytes + id_bytes) - id_bytes);
}

void WaitingSort::sweep(const std::array<Buffer<uint>, 2>& codes, const Buffer<uint>& ids_a,
                        const Buffer<uint>& ids_b, uint count, Queue& queue)
{
    const uint tiles = divided_up(count, tile_);
    const Buffer<uint>& counters = counters_[turn_];
    turn_ = 1 - turn_;
    const std::int64_t id_bytes = std::int64_t{count} * sizeof(uint);
    const std::int64_t code_bytes = id_bytes * code_words_;

    set_arguments(count_, codes[0], counters, count, code_bits_);
    const std::size_t counting = units_ * counting_groups_per_unit;
    queue.launch(count_, std::min<std::size_t>(tiles, counting) * group_size_, group_size_,
                 code_bytes);
    for (uint pass = 0; pass < passes_; ++pass) {
        const bool is_even = pass % 2 == 0;
        set_arguments(sort_, codes[pass % 2], is_even ? ids_a : ids_b, codes[(pass + 1) % 2],
                      is_even ? ids_b : ids_a, counters, counters_[turn_], states_, count, pass,
                      epoch_ + pass);
        queue.launch(sort_, std::size_t{tiles} * group_size_, group_size_,
                     2 * code_bytes + (pass == 0 ? 1 : 2) * id_bytes);
    }
}

}  // namespace bvhbench
