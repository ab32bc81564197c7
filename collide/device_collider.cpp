// SPDX-License-Identifier: MIT
#include "collide/device_collider.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

#include "collide/counters.h"
#include "geometry/bits.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

/// What a group of `group` keeps in local memory grows with its size: this many fit into 48 KB.
constexpr std::size_t most_group_size = 256;

uint chosen_group_size(const Device& device, unsigned asked, unsigned usual)
{
    const std::size_t most = std::min<std::size_t>(
        most_group_size, std::bit_floor(device.cl.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>()));
    if (asked == 0)
        return static_cast<uint>(std::min<std::size_t>(usual, most));
    if (!std::has_single_bit(asked) || asked > most)
        throw BadUsage("a collider's group size is a power of two up to " + std::to_string(most) +
                       " on " + device.name() + ", not " + std::to_string(asked));
    return asked;
}

}  // namespace

DeviceCollider::DeviceCollider(Programs& programs, const ColliderCard& card,
                               const ColliderOptions& options, unsigned usual_group_size)
    : options_(options)
    , group_size_(chosen_group_size(programs.device(), options.group_size, usual_group_size))
    , chunks_(chunk_count(programs.device()))
    , programs_(programs)
    , card_(card)
    , form_(chosen_form(programs.device(), options.form))
{}

std::string DeviceCollider::refusal(const Tree& tree) const
{
    if (dynamic_cast<const DeviceTree*>(&tree) != nullptr)
        return {};
    return std::string(card_.name) + " needs a tree in device memory";
}

cl::Kernel DeviceCollider::kernel(const DeviceTree& tree, std::string_view path, const char* name,
                                  std::vector<Define> more) const
{
    more.push_back({"SORTED_LEAVES", tree.has_sorted_leaves() ? 1u : 0u});
    more.push_back({"KEEP_ADJACENT", options_.keep_adjacent ? 1u : 0u});
    return programs_.kernel(tree.access_header(), path, name, more);
}

void DeviceCollider::reserve(const Tree* tree, const Input&)
{
    assert(tree != nullptr);
    if (const std::string why = refusal(*tree); !why.empty())
        throw BadUsage(why);
    tree_ = dynamic_cast<const DeviceTree*>(tree);
    compile(*tree_);
    if (has_ropes(*tree_))
        ropes_kernel_ = kernel(*tree_, "collide/ropes.cl", "ropes", {});
    capacity_ = options_.capacity != 0
                    ? options_.capacity
                    : std::max<std::size_t>(1024, 8 * std::size_t{tree_->leaf_count()});
    take_memory();
}

void DeviceCollider::take_all(Arena& arena)
{
    counters_ = arena.take<uint>(QUEUES_COUNT + 2 * queue_count(*tree_), Use::scratch);
    ropes_ = arena.take<uint>(has_ropes(*tree_) ? 2 * std::size_t{tree_->leaf_count()} - 1 : 1,
                              Use::scratch);
    plan(arena, *tree_);
    pairs_ = arena.take<Pair>(capacity_, Use::scratch);
}

void DeviceCollider::take_memory()
{
    if (arena_)
        set_aside(cl::CommandQueue(device().context, device().cl));
    Arena measuring = Arena::measuring(device());
    take_all(measuring);
    arena_.reset();  // the old memory goes before the new comes
    arena_ = Arena::reserved(device(), measuring.used());
    take_all(*arena_);
    prepare(*tree_, cl::CommandQueue(device().context, device().cl));
}

void DeviceCollider::enqueue_ropes(const DeviceTree& tree, Queue& queue)
{
    const std::size_t group = by_groups() ? group_size_ : 1;
    const std::size_t items =
        by_groups() ? divided_up(tree.leaf_count(), group_size_) * group : chunks_;
    set_arguments_from(ropes_kernel_, tree.bind(ropes_kernel_, 0), ropes_);
    queue.begin("ropes");
    queue.launch(
        ropes_kernel_, items, group,
        2 * static_cast<std::int64_t>(ropes_.bytes()));  // each child read, each rope written
}

void DeviceCollider::query(const Tree* tree, const Input& input, Queue& queue)
{
    const auto& on_device = dynamic_cast<const DeviceTree&>(*tree);
    assert(tree_ != nullptr && on_device.leaf_count() == tree_->leaf_count());
    const bool has_pairs = on_device.leaf_count() > 1;
    if (has_ropes(on_device) && has_pairs)
        enqueue_ropes(on_device, queue);
    queue.begin("broad");
    queue.clear(counters_.cl(), counters_.bytes());
    if (has_pairs)
        enqueue(on_device, input, queue);
}

std::vector<std::uint64_t> DeviceCollider::counters(const Queue& queue) const
{
    const std::vector<uint> words = counters_.download(queue.cl());
    std::vector<std::uint64_t> counts;
    for (std::size_t k = 0; k < words.size(); k += 2)
        counts.push_back(words[k] | std::uint64_t{words[k + 1]} << 32);
    return counts;
}

bool DeviceCollider::complete(const Queue& queue)
{
    const std::vector<std::uint64_t> counts = counters(queue);
    const std::uint64_t found = counts[PAIRS_COUNT / 2];
    const bool had_room = found <= capacity_;
    if (!had_room) {
        constexpr std::uint64_t most = std::numeric_limits<uint>::max();
        if (found > most)
            throw Unavailable(std::to_string(found) + " pairs or more: a query holds at most " +
                              std::to_string(most));
        capacity_ = static_cast<std::size_t>(std::min(most, found + found / 8));
    }
    const bool queues_had_room = make_room(counts[TASKS_COUNT / 2],
                                           {counts.begin() + QUEUES_COUNT / 2, counts.end()});
    if (had_room && queues_had_room)
        return true;
    take_memory();
    return false;
}

QueryCounts DeviceCollider::counts(const Queue& queue) const
{
    const std::vector<std::uint64_t> counts = counters(queue);
    QueryCounts result{counts[PAIRS_COUNT / 2], counts[BOX_TESTS_COUNT / 2], {}, {}};
    if (tree_->objects.size() > 1)
        result.tasks = counts[TASKS_COUNT / 2];
    return result;
}

std::vector<Pair> DeviceCollider::pairs(const Queue& queue) const
{
    std::vector<Pair> found(static_cast<std::size_t>(counters(queue)[PAIRS_COUNT / 2]));
    assert(found.size() <= pairs_.size());
    if (!found.empty())
        queue.cl().enqueueReadBuffer(pairs_.cl(), CL_TRUE, 0, found.size() * sizeof(Pair),
                                     found.data());
    return found;
}

}  // namespace bvhbench
