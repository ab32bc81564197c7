// SPDX-License-Identifier: MIT
#include "builders/stages/sort/waiting_sort.h"

#include <algorithm>
#include <cassert>

#include "builders/device_tree.h"
#include "builders/parameters.h"
#include "builders/stages/codes.h"
#include "geometry/bits.h"
#include "geometry/scene_bounds.h"

namespace bvhbench {
namespace {

constexpr uint digits = 1u << tile_digit_bits;

/// Bits of the epoch in a look-back state (look_back.clh). Epoch 0 is that of cleared states.
constexpr uint state_epoch_bits = 31;
constexpr uint last_epoch = (1u << state_epoch_bits) - 1;

/// In a posted pair (at_once.clh): bits of an id, and of the epoch above the id and the 24 bits of a code that are left.
constexpr uint post_id_bits = 28;
constexpr uint last_post_epoch = (1u << (64 - 24 - post_id_bits)) - 1;

constexpr std::size_t bounds_words = sizeof(Bounds) / sizeof(float);  ///< SIDES of order_at_once.cl

/// Local memory for a tile of words of 64 bits. A group has 48 KiB, of which the digits' tables take 3.
constexpr uint wide_tile_bytes = 40 << 10;

constexpr std::size_t counting_groups_per_unit = 2;  ///< that count digits

/// Fewest keys per work-item in one launch: with fewer, there are more groups, which wait for each other.
constexpr uint fewest_keys = 2;

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

std::vector<Define> WaitingSort::defines(uint keys) const
{
    return {{"GROUP_SIZE", group_size_},         {"KEYS_PER_ITEM", keys},
            {"DIGIT_BITS", tile_digit_bits},     {"MOST_PASSES", most_tile_passes},
            {"MOST_TILES", most_tiles_at_once_}, {"FEW_TILES", few_tiles},
            {"POST_ID_BITS", post_id_bits},      {"STATE_EPOCH_BITS", state_epoch_bits}};
}

cl::Kernel WaitingSort::kernel(const char* path, const char* name, uint keys) const
{
    std::vector<Define> all = defines(keys);
    all.push_back({"CODE_WORDS", code_words_});
    return programs_.kernel(path, name, all, Optimise::on_gpus);
}

cl::Kernel WaitingSort::word_kernel(const WordPass& pass, uint keys) const
{
    std::vector<Define> all = defines(keys);
    all.insert(all.end(), {{"CODE_WORDS", pass.is_narrow ? 1u : 2u},
                           {"READS", static_cast<uint>(pass.reads)},
                           {"WRITES", static_cast<uint>(pass.writes)},
                           {"IF_RUNS", static_cast<uint>(pass.if_runs)}});
    return programs_.kernel("builders/stages/sort/sweep_words.cl", "sweep_words", all,
                            Optimise::on_gpus);
}

cl::Kernel WaitingSort::beginning_with(const char* path, const char* name,
                                       std::span<const Define> more) const
{
    std::vector<Define> all = defines(tile_ / group_size_);
    all.insert(all.end(), more.begin(), more.end());
    return programs_.kernel(path, name, all, Optimise::on_gpus);
}

void WaitingSort::plan(Arena& arena, std::size_t size, bool keeps_codes)
{
    epoch_ = 1;
    turn_ = 0;
    is_at_once_ = most_keys_at_once_ > 0 &&
                  size <= std::size_t{most_tiles_at_once_} * group_size_ * most_keys_at_once_;
    keeps_codes_ = keeps_codes;
    const auto count = static_cast<uint>(size);
    size_ = count;
    id_bits_ = ceil_log2(std::max(count, 1u));
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
    word_passes_.clear();
    const std::size_t tiles = divided_up(count, tile_);
    states_ = arena.take<ulong>(2 * (2 * tiles + 1) * digits + bounds_words * tiles, Use::scratch);
    posts_ = arena.take<ulong>(2 * std::size_t{code_words_} * count, Use::scratch);
}

void WaitingSort::plan_sweeps(Arena& arena, uint count)
{
    const uint most_keys = wide_tile_bytes / uint{sizeof(ulong)} / group_size_;
    const uint keys =
        sorts_words() ? std::min(keys_, most_keys) : std::max(1u, keys_ / code_words_);
    tile_ = group_size_ * keys;
    count_ = kernel("builders/stages/sort/sweep.cl", "count_digits", keys);
    if (!sorts_words())
        sort_ = kernel("builders/stages/sort/sweep.cl", "sweep", keys);
    word_passes_.clear(), word_kernels_.clear();
    if (sorts_words())
        word_passes_ = low_passes() > 0 ? passes_of_parts(passes_)
                                        : narrowing_passes(code_bits_, tile_digit_bits, id_bits_);
    for (const WordPass& pass : word_passes_)
        word_kernels_.push_back(word_kernel(pass, keys));
    if (sorts_words() && low_passes() > 0) {
        expect_runs_ = kernel("builders/stages/sort/sort_runs.cl", "expect_runs", keys);
        sort_runs_ = kernel("builders/stages/sort/sort_runs.cl", "sort_runs", keys);
    }
    for (Buffer<uint>& counters : counters_)
        counters = arena.take<uint>(most_tile_passes * (digits + 1) + 1, Use::scratch);
    states_ = arena.take<ulong>(std::size_t{divided_up(count, tile_)} * digits, Use::scratch);
    posts_ = {};
}

void WaitingSort::prepare(const cl::CommandQueue& queue)
{
    if (states_.size() == 0)
        return;
    queue.enqueueFillBuffer(states_.cl(), cl_uint{0}, 0, states_.bytes());
    if (posts_.size() > 0)
        queue.enqueueFillBuffer(posts_.cl(), cl_uint{0}, 0, posts_.bytes());
    for (const Buffer<uint>& counters : counters_)
        if (counters.size() > 0)
            queue.enqueueFillBuffer(counters.cl(), cl_uint{0}, 0, counters.bytes());
    queue.finish();
}

/// Returns the epochs of a sort: one for each pass, and for each that is seldom needed.
uint WaitingSort::epochs() const
{
    return std::max(passes_, static_cast<uint>(word_passes_.size()));
}

/// Begins the next sort: clears what passes leave if their epochs have been used up.
void WaitingSort::next_epochs(Queue& queue)
{
    const uint last = is_at_once_ ? last_post_epoch : last_epoch;
    if (epoch_ <= last - epochs())
        return;
    queue.clear(states_.cl(), states_.bytes());
    if (is_at_once_)
        queue.clear(posts_.cl(), posts_.bytes());
    epoch_ = 1;
}

void WaitingSort::enqueue(const Buffer<uint>& unsorted, const std::array<Buffer<uint>, 2>& codes,
                          const Buffer<uint>& result, const Buffer<uint>& other, uint count,
                          bool is_counted, Queue& queue)
{
    next_epochs(queue);
    if (is_at_once_) {
        set_arguments(sort_, codes[0], codes[1], result, states_, posts_, count, passes_, epoch_,
                      keeps_codes_ ? 1u : 0u);
        queue.launch(sort_, std::size_t{divided_up(count, tile_)} * group_size_, group_size_,
                     bytes_at_once(count));
    } else {
        if (!is_counted)
            count_digits(unsorted, count, queue);
        const bool is_odd = passes_ % 2 == 1;  // the last pass writes ids to `result`
        if (sorts_words())
            sweep_words(unsorted, codes, result, count, queue);
        else
            sweep(codes, is_odd ? other : result, is_odd ? result : other, count, queue);
        turn_ = 1 - turn_;
    }
    epoch_ += epochs();
}

void WaitingSort::enqueue_beginning(cl::Kernel& kernel, cl_uint next,
                                    const std::array<Buffer<uint>, 2>& codes,
                                    const Buffer<uint>& result, std::int64_t moved_bytes,
                                    Queue& queue)
{
    assert(is_at_once_);
    next_epochs(queue);
    set_arguments_from(kernel, next, codes[0], codes[1], result, states_, posts_, size_, passes_,
                       epoch_, keeps_codes_ ? 1u : 0u);
    queue.launch(kernel, std::size_t{divided_up(size_, tile_)} * group_size_, group_size_,
                 moved_bytes + bytes_at_once(size_));
    epoch_ += passes_;
}

/// Returns the bytes that a sort in one launch moves: codes read, pairs posted and taken, ids and kept codes written.
std::int64_t WaitingSort::bytes_at_once(uint count) const
{
    const std::int64_t words = std::int64_t{count} * code_words_;
    const std::int64_t post_bytes = words * std::int64_t{sizeof(ulong)};
    const std::int64_t code_bytes = words * std::int64_t{sizeof(uint)};
    return (keeps_codes_ ? 3 : 1) * code_bytes + (passes_ - 1) * 2 * post_bytes +
           std::int64_t{count} * std::int64_t{sizeof(uint)};
}

void WaitingSort::count_digits(const Buffer<uint>& codes, uint count, Queue& queue)
{
    set_arguments(count_, codes, counters_[turn_], count, code_bits_);
    const std::size_t groups =
        std::min<std::size_t>(divided_up(count, tile_), units_ * counting_groups_per_unit);
    queue.launch(count_, groups * group_size_, group_size_,
                 std::int64_t{count} * code_words_ * std::int64_t{sizeof(uint)});
}

void WaitingSort::sweep(const std::array<Buffer<uint>, 2>& codes, const Buffer<uint>& ids_a,
                        const Buffer<uint>& ids_b, uint count, Queue& queue)
{
    const std::int64_t id_bytes = std::int64_t{count} * sizeof(uint);
    for (uint pass = 0; pass < passes_; ++pass) {
        const bool is_even = pass % 2 == 0;
        set_arguments(sort_, codes[pass % 2], is_even ? ids_a : ids_b, codes[(pass + 1) % 2],
                      is_even ? ids_b : ids_a, counters_[turn_], counters_[1 - turn_], states_,
                      count, pass, epoch_ + pass, pass + 1 == passes_ ? 1u : 0u);
        queue.launch(sort_, std::size_t{divided_up(count, tile_)} * group_size_, group_size_,
                     (2 * code_words_ + (pass == 0 ? 1 : 2)) * id_bytes);
    }
}

void WaitingSort::sweep_words(const Buffer<uint>& unsorted, const std::array<Buffer<uint>, 2>& two,
                              const Buffer<uint>& result, uint count, Queue& queue)
{
    const std::int64_t word_bytes = std::int64_t{count} * sizeof(uint);
    if (low_passes() > 0) {
        set_arguments(expect_runs_, counters_[turn_], count, low_passes(), passes_);
        queue.launch(expect_runs_, group_size_, group_size_,
                     std::int64_t{high_passes * digits} * std::int64_t{sizeof(uint)});
    }
    for (uint k = 0; k < word_passes_.size(); ++k) {
        const WordPass& own = word_passes_[k];
        const bool is_before_runs = low_passes() > 0 && k < high_passes;
        const uint from = is_before_runs ? (own.pass + 1) % 2 : own.pass % 2;
        set_arguments(word_kernels_[k], own.reads == WordPass::Reads::words ? two[from] : unsorted,
                      own.writes == WordPass::Writes::ids ? result : two[1 - from],
                      counters_[turn_], counters_[1 - turn_], states_, count, own.pass, epoch_ + k,
                      own.first_pass, id_bits_, unsorted, low_passes() * tile_digit_bits);
        queue.launch(word_kernels_[k], std::size_t{divided_up(count, tile_)} * group_size_,
                     group_size_, own.moved * word_bytes);
        if (is_before_runs && k + 1 == high_passes) {
            set_arguments(sort_runs_, two[1 - from], unsorted, result, counters_[turn_], count,
                          id_bits_);
            queue.launch(sort_runs_, std::size_t{divided_up(count, group_size_)} * group_size_,
                         group_size_, 3 * word_bytes);
        }
    }
}

}  // namespace bvhbench
