// SPDX-License-Identifier: MIT
#include "builders/stages/sort/sort_at_once.h"

#include <algorithm>
#include <cassert>

#include "builders/stages/codes.h"
#include "builders/stages/sort/tile_digits.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr uint fewest_keys =
    4;  // a work-item: with fewer, groups read more of each other than they sort

}  // namespace

SortAtOnce::SortAtOnce(Programs& programs, unsigned code_bits, uint group_size, uint most_keys)
    : programs_(programs)
    , code_bits_(code_bits)
    , passes_(divided_up(code_bits, tile_digit_bits))
    , group_size_(group_size)
    , most_keys_(most_keys)
    , most_tiles_(programs.device().lets_groups_wait()
                      ? programs.device().cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()
                      : 1)
{
    assert(group_size >= 16 && group_size <= 512);
}

bool SortAtOnce::takes(std::size_t size) const
{
    return size <= std::size_t{most_tiles_} * group_size_ * most_keys_;
}

void SortAtOnce::plan(Arena& arena, std::size_t size)
{
    assert(takes(size));
    const auto count = static_cast<uint>(size);
    const uint keys =
        std::min(most_keys_, std::max(fewest_keys, divided_up(count, group_size_ * most_tiles_)));
    tile_ = group_size_ * keys;
    epoch_ = 1;
    sort_ = programs_.kernel("builders/stages/sort/sort_at_once.cl", "sort_at_once",
                             {{"GROUP_SIZE", group_size_},
                              {"KEYS_PER_ITEM", keys},
                              {"CODE_WORDS", code_words(code_bits_)},
                              {"DIGIT_BITS", tile_digit_bits},
                              {"STATE_EPOCH_BITS", state_epoch_bits}},
                             Optimise::on_gpus);
    states_ =
        arena.take<ulong>(std::size_t{divided_up(count, tile_)} * (tile_digits + 1), Use::scratch);
}

void SortAtOnce::prepare(const cl::CommandQueue& queue)
{
    if (states_.size() == 0)
        return;
    queue.enqueueFillBuffer(states_.cl(), cl_uint{0}, 0, states_.bytes());
    queue.finish();
}

void SortAtOnce::enqueue(const std::array<Buffer<uint>, 2>& codes, const Buffer<uint>& result,
                         const Buffer<uint>& other, uint count, Queue& queue)
{
    if (epoch_ > last_epoch - passes_) {
        queue.clear(states_.cl(), states_.bytes());
        epoch_ = 1;
    }
    // From here on ids go as codes do: to the result with the last pass.
    const bool is_odd = passes_ % 2 == 1;
    const Buffer<uint>& ids_a = is_odd ? other : result;
    const Buffer<uint>& ids_b = is_odd ? result : other;
    const std::int64_t id_bytes = std::int64_t{count} * sizeof(uint);
    const std::int64_t code_bytes = id_bytes * code_words(code_bits_);
    set_arguments(sort_, codes[0], ids_a, codes[1], ids_b, states_, count, passes_, epoch_);
    queue.launch(sort_, std::size_t{divided_up(count, tile_)} * group_size_, group_size_,
                 passes_ * 2 * (code_bytes + id_bytes) - id_bytes);
    epoch_ += passes_;
}

}  // namespace bvhbench
