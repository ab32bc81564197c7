// SPDX-License-Identifier: MIT
#include "builders/stages/sort/sweep.h"

#include <algorithm>
#include <cassert>

#include "builders/parameters.h"
#include "builders/stages/codes.h"
#include "builders/stages/sort/tile_digits.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr auto path = "builders/stages/sort/sweep.cl";

}  // namespace

DigitSweeps::DigitSweeps(Programs& programs, unsigned code_bits, uint group_size,
                         uint keys_per_item)
    : programs_(programs)
    , code_bits_(code_bits)
    , passes_(divided_up(code_bits, tile_digit_bits))
    , group_size_(group_size)
    , most_keys_(keys_per_item)
    , units_(programs.device().cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>())
{
    assert(group_size >= 16 && group_size <= 512);
}

/// As many as asked for, or half as many where that would leave half of the compute units without a tile.
uint DigitSweeps::keys_for(std::size_t size) const
{
    const bool is_small = size < std::size_t{units_} * group_size_ * most_keys_ / 2;
    return is_small ? divided_up(most_keys_, 2u) : most_keys_;
}

void DigitSweeps::plan(Arena& arena, std::size_t size)
{
    const uint keys = keys_for(size);
    const auto kernel = [&](const char* name) {
        return programs_.kernel(path, name,
                                {{"GROUP_SIZE", group_size_},
                                 {"KEYS_PER_ITEM", keys},
                                 {"CODE_WORDS", code_words(code_bits_)},
                                 {"DIGIT_BITS", tile_digit_bits},
                                 {"MOST_PASSES", most_tile_passes},
                                 {"STATE_EPOCH_BITS", state_epoch_bits}},
                                Optimise::on_gpus);
    };
    count_ = kernel("count_digits");
    sweep_ = kernel("sweep");
    tile_ = group_size_ * keys;
    epoch_ = 0;
    turn_ = 0;
    for (Buffer<uint>& counters : counters_)
        counters = arena.take<uint>(most_tile_passes * (tile_digits + 1), Use::scratch);
    states_ = arena.take<ulong>(
        std::size_t{divided_up(static_cast<uint>(size), tile_)} * tile_digits, Use::scratch);
}

void DigitSweeps::prepare(const cl::CommandQueue& queue)
{
    if (states_.size() == 0)
        return;
    queue.enqueueFillBuffer(states_.cl(), cl_uint{0}, 0, states_.bytes());
    for (const Buffer<uint>& counters : counters_)
        queue.enqueueFillBuffer(counters.cl(), cl_uint{0}, 0, counters.bytes());
    queue.finish();
}

void DigitSweeps::enqueue(const std::array<Buffer<uint>, 2>& codes, const Buffer<uint>& result,
                          const Buffer<uint>& other, uint count, Queue& queue)
{
    const uint tiles = divided_up(count, tile_);
    if (epoch_ > last_epoch - passes_) {
        queue.clear(states_.cl(), states_.bytes());
        epoch_ = 0;
    }
    const Buffer<uint>& counters = counters_[turn_];
    turn_ = 1 - turn_;
    const std::size_t id_bytes = count * sizeof(uint);
    const std::size_t code_bytes = id_bytes * code_words(code_bits_);

    set_arguments(count_, codes[0], counters, count, code_bits_);
    const std::size_t counting = units_ * programs_.device().tuned(sweep_counting_groups_per_unit);
    queue.launch(count_, std::min<std::size_t>(tiles, counting) * group_size_, group_size_,
                 static_cast<std::int64_t>(code_bytes));
    for (uint pass = 0; pass < passes_; ++pass) {
        const bool to_result = (passes_ - pass) % 2 == 1;
        const Buffer<uint>& from = to_result ? other : result;
        const Buffer<uint>& to = to_result ? result : other;
        set_arguments(sweep_, codes[pass % 2], from, codes[(pass + 1) % 2], to, counters,
                      counters_[turn_], states_, count, pass, ++epoch_);
        queue.launch(sweep_, std::size_t{tiles} * group_size_, group_size_,
                     static_cast<std::int64_t>(2 * code_bytes + (pass == 0 ? 1 : 2) * id_bytes));
    }
}

}  // namespace bvhbench
