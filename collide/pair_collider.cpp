// SPDX-License-Identifier: MIT
#include "collide/pair_collider.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

#include "collide/counters.h"
#include "geometry/error.h"
#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

/// What a group of `group` keeps in local memory grows with its size: this many fit into 48 KB.
constexpr std::size_t most_group_size = 256;

uint chosen_group_size(const Device& device, KernelForm form, unsigned asked,
                       const Parameter& usual)
{
    const std::size_t most = std::min<std::size_t>(
        most_group_size, std::bit_floor(device.cl.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>()));
    if (asked == 0 && chosen_form(device, form) == KernelForm::chunks)
        return 1;  // groups of the form for few cores are of one work-item
    if (asked == 0)
        return static_cast<uint>(std::min<std::size_t>(device.tuned(usual), most));
    if (!std::has_single_bit(asked) || asked > most || asked < usual.least)
        throw BadUsage("a collider's group size is a power of two from " +
                       std::to_string(usual.least) + " up to " + std::to_string(most) + " on " +
                       device.name() + ", not " + std::to_string(asked));
    return asked;
}

}  // namespace

PairCollider::PairCollider(Programs& programs, const ColliderCard& card,
                           const ColliderOptions& options, const Parameter& group_size)
    : options_(options)
    , group_size_(
          chosen_group_size(programs.device(), options.form, options.group_size, group_size))
    , chunks_(chunk_count(programs.device()))
    , programs_(programs)
    , card_(card)
    , form_(chosen_form(programs.device(), options.form))
{}

void PairCollider::take_memory_for(std::size_t triangles)
{
    capacity_ = options_.capacity != 0
                    ? options_.capacity
                    : device().room_for(std::max<std::size_t>(1024, 8 * triangles), sizeof(Pair));
    take_memory();
}

void PairCollider::take_all(Arena& arena)
{
    counters_ = arena.take<uint>(QUEUES_COUNT + 2 * wide_counters(), Use::scratch);
    plan_rest(arena);
    pairs_ = arena.take<Pair>(capacity_, Use::scratch);
}

void PairCollider::take_memory()
{
    if (arena_)
        save(cl::CommandQueue(device().context, device().cl));
    Arena measuring = Arena::measuring(device());
    take_all(measuring);
    arena_.reset();  // the old memory goes before the new comes
    arena_ = Arena::reserved(device(), measuring.used());
    take_all(*arena_);
    write_down(cl::CommandQueue(device().context, device().cl));
}

std::vector<std::uint64_t> PairCollider::counters(const Queue& queue) const
{
    const std::vector<uint> words = counters_.download(queue.cl());
    std::vector<std::uint64_t> counts;
    for (std::size_t k = 0; k < words.size(); k += 2)
        counts.push_back(words[k] | std::uint64_t{words[k + 1]} << 32);
    return counts;
}

bool PairCollider::complete(const Queue& queue)
{
    const std::vector<std::uint64_t> counts = counters(queue);
    const std::uint64_t found = counts[PAIRS_COUNT / 2];
    const bool had_room = found <= capacity_;
    if (!had_room) {
        constexpr std::uint64_t most = std::numeric_limits<uint>::max();
        if (found > most)
            throw Unavailable(std::to_string(found) + " pairs or more: a query holds at most " +
                              std::to_string(most));
        capacity_ = device().room_for(std::min(most, found + found / 8), sizeof(Pair), found);
    }
    const bool queues_had_room =
        make_room(counts[TASKS_COUNT / 2], {counts.begin() + QUEUES_COUNT / 2, counts.end()});
    if (had_room && queues_had_room)
        return true;
    take_memory();
    return false;
}

QueryCounts PairCollider::counts(const Queue& queue) const
{
    const std::vector<std::uint64_t> counts = counters(queue);
    return {counts[PAIRS_COUNT / 2], counts[BOX_TESTS_COUNT / 2], {}, {}};
}

std::vector<Pair> PairCollider::pairs(const Queue& queue) const
{
    const auto count = static_cast<std::size_t>(counters(queue)[PAIRS_COUNT / 2]);
    require_host_memory("the pairs found, " + std::to_string(count) + " of them,",
                        count * sizeof(Pair));
    std::vector<Pair> found(count);
    assert(found.size() <= pairs_.size());
    if (!found.empty())
        queue.cl().enqueueReadBuffer(pairs_.cl(), CL_TRUE, 0, found.size() * sizeof(Pair),
                                     found.data());
    return found;
}

}  // namespace bvhbench
