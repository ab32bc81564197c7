// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>

#include "collide/counters.h"
#include "collide/device_collider.h"
#include "collide/device_lists.h"
#include "collide/object_order.h"
#include "collide/parameters.h"
#include "collide/queues/node_pairs.h"
#include "collide/walks/task.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr uint most_jump = 5;  // 4^5 tasks per entry
constexpr uint most_start_level = 12;
constexpr uint all_steps = std::numeric_limits<uint>::max();

class Bvtt final : public DeviceCollider {
public:
    Bvtt(Programs& programs, const ColliderOptions& options)
        : DeviceCollider(programs,
                         {"bvtt", "Level-synchronous traversal with jumps [Chitalu2020, Sec. 5]"},
                         options, bvtt_group_size, Wants::tree)
    {
        if (options.jump > most_jump)
            throw BadUsage("bvtt jumps at most " + std::to_string(most_jump) + " levels, not " +
                           std::to_string(options.jump));
        if (options.start_level > most_start_level)
            throw BadUsage("bvtt starts on level " + std::to_string(most_start_level) +
                           " at most, not " + std::to_string(options.start_level));
    }

    QueryCounts counts(const Queue& queue) const override
    {
        QueryCounts counts = DeviceCollider::counts(queue);
        const std::vector<std::uint64_t> all = wide_counts(counters_, queue);
        counts.bvtt_peak = std::max<std::uint64_t>(
            1, *std::max_element(all.begin() + QUEUES_COUNT / 2, all.end()));
        if (counts.tasks)
            counts.tasks = all[QUEUES_COUNT / 2];  // pairs of roots in the first queue
        counts.more = {{"used_start_level", starts_on()}, {"used_jump", jumps()}};
        return counts;
    }

private:
    std::string objection(const DeviceTree& tree) const override
    {
        if (!tree.is_implicit() && (options_.jump > 1 || options_.start_level > 0))
            return "bvtt can neither jump nor start below the root in a tree with pointers";
        const uint bits = tree.child_bits();
        if (bits * options_.jump > most_jump || bits * options_.start_level > most_start_level)
            return "bvtt jumps at most " + std::to_string(most_jump / bits) +
                   " levels and starts on level " + std::to_string(most_start_level / bits) +
                   " at most where a node has " + std::to_string(1u << bits) + " children";
        return naming_objection("bvtt", tree);
    }

    /// Returns `asked` if set; else the device's tuned value where descendants are found by arithmetic; else 0. Tuned values
    /// count levels of a binary tree: used unscaled, 8 levels of an 8-wide tree would be 2^48 pairs per entry.
    uint chosen(uint asked, const Parameter& parameter) const
    {
        return asked != 0             ? asked
               : tree().is_implicit() ? device().tuned(parameter) / tree().child_bits()
                                      : 0;
    }

    /// Level that the traversal starts on, 0 for the root, and levels that each step descends; the leaves may be nearer.
    uint starts_on() const
    {
        return skips(skip_start_level) ? chosen(options_.start_level, bvtt_start_level) : 0;
    }
    uint jumps() const { return std::max(1u, chosen(options_.jump, bvtt_jump)); }

    /// Levels that each step descends. A start level below the root is reached by a first jump.
    std::vector<uint> steps() const
    {
        uint left = tree().most_levels() - 1;
        if (object_count() > 1)  // pairs of roots that are leaves need a step as well
            left = std::max(left, 1u);
        std::vector<uint> steps;
        if (starts_on() > 0 && left > 0)
            steps.push_back(std::min(starts_on(), left));
        const uint jump = jumps();
        for (left -= steps.empty() ? 0 : steps.front(); left > 0; left -= steps.back())
            steps.push_back(std::min(jump, left));
        return steps;
    }

    void compile(const Input& input) override
    {
        block_pairs_ = by_groups() ? 0 : node_pairs_in_block;
        queue_count_ = static_cast<uint>(steps().size()) + 1;  // and the output of the last step
        const Define label{"LABEL_BITS", node_bits(tree())};
        const Define one_object{"ONE_OBJECT", object_count() == 1 ? 1u : 0u};
        order_ = object_order(input);
        std::vector<Define> of_roots = {label,
                                        {"SWEEP_LANES", by_groups() ? ObjectOrder::lanes : 1u},
                                        {"SKIP_APART", skips(skip_apart) ? 1u : 0u}};
        if (is_filtered())
            of_roots.insert(of_roots.end(),
                            {{"FILTERED", 1u}, {"BETWEEN", between(object_count()) ? 1u : 0u}});
        if (object_count() > 1)
            roots_ = kernel(order_ ? "collide/queues/many_roots.cl" : "collide/queues/roots.cl",
                            order_ ? "sweep_roots" : "find_roots", of_roots);
        expand_ = by_groups() ? kernel("collide/queues/bvtt_groups.cl", "expand",
                                       {{"GROUP_SIZE", group_size_},
                                        {"ITEMS", device().tuned(bvtt_items)},
                                        one_object,
                                        label})
                              : kernel("collide/queues/bvtt_chunks.cl", "expand",
                                       {{"SINK_BLOCK", block_pairs_}, one_object, label});
        queue_room_ = first_room(std::max<std::size_t>(1024, 8 * std::size_t{triangles_}));
    }

    void plan(Arena& arena) override
    {
        for (Buffer<Pair>& queue : queues_)
            queue = arena.take<Pair>(queue_room_, Use::scratch);
        if (order_)
            order_->plan(arena, tree());
        if (!by_groups())
            blocks_ = arena.take<Pair>(2 * block_pairs_ * chunks_, Use::scratch);
    }

    void fill(const cl::CommandQueue& queue) override
    {
        if (order_)
            order_->prepare(queue);
    }

    bool make_room(std::uint64_t, const std::vector<std::uint64_t>& sizes) override
    {
        // False if the last launched step left entries although the tree has more steps; then the next query launches all steps.
        const bool ended = launched_ + 1 == sizes.size() || sizes[launched_] == 0;
        // With one object, the first entry (the root with itself) is in no queue.
        const auto first_empty =
            std::find(sizes.begin() + (object_count() == 1 ? 1 : 0), sizes.end(), 0u);
        needed_steps_ = ended ? static_cast<uint>(first_empty - sizes.begin()) : all_steps;
        // Steps after an overflow have seen only some of their entries, so they will need more than was counted.
        const std::uint64_t most = *std::max_element(sizes.begin(), sizes.end());
        return had_room(queue_room_, most, most, sizeof(Pair), device(), "pairs of nodes") && ended;
    }

    void enqueue(const Input& input, Queue& queue) override
    {
        const bool one_object = object_count() == 1;
        if (one_object && (!within() || !options_.filter.allows(0, 0)))
            return;
        const auto room = static_cast<uint>(queue_room_);
        if (order_) {
            order_->enqueue(tree(), queue);
            order_->bind(roots_, tree().bind(roots_, 0), within() ? 1u : 0u, queues_[0], room,
                         counters_);
            launch(roots_, std::size_t{object_count()} * (by_groups() ? ObjectOrder::lanes : 1), 64,
                   queue);
        } else if (!one_object) {
            set_arguments_from(roots_, tree().bind(roots_, 0), object_count(), within() ? 1u : 0u,
                               between(object_count()) ? 1u : 0u, queues_[0], room, counters_);
            launch(roots_,
                   std::size_t{object_count()} * divided_up(object_count(), OTHERS_AT_A_TIME), 64,
                   queue);
        }
        launched_ = 0;
        uint depth = 0;
        for (const uint levels : steps()) {
            if (launched_ == needed_steps_ && skips(skip_empty_queue))
                break;
            const Buffer<Pair>&from = queues_[launched_ % 2], &to = queues_[(launched_ + 1) % 2];
            depth += tree().child_bits() * levels;
            if (by_groups()) {
                bind(expand_, input, from, to, room, launched_, levels);
                // With one object, there are no more tasks than pairs of nodes at this depth.
                const std::size_t tasks = std::size_t{1}
                                          << (one_object ? std::min(2 * depth, 40u) : 40);
                launch(expand_,
                       group_count(device(), tasks,
                                   std::size_t{group_size_} * device().tuned(bvtt_items)) *
                           group_size_,
                       group_size_, queue);
            } else {
                bind(expand_, input, from, to, room, launched_, levels, blocks_);
                launch(expand_, chunks_, 1, queue);
            }
            ++launched_;
        }
    }

    cl::Kernel roots_, expand_;
    std::unique_ptr<ObjectOrder> order_;  ///< of many objects
    uint block_pairs_ = 0;                ///< entries per block, in the chunk form
    uint launched_ = 0;                   ///< steps launched by the last query
    uint needed_steps_ = all_steps;       ///< steps that had entries to expand in the last query
    std::size_t queue_room_ = 0;
    std::array<Buffer<Pair>, 2> queues_;  ///< node pairs: read and written by turns
    Buffer<Pair> blocks_;
};

}  // namespace

std::unique_ptr<Collider> make_bvtt(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Bvtt>(programs, options);
}

}  // namespace bvhbench
