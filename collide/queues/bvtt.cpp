// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>

#include "collide/colliders.h"
#include "collide/counters.h"
#include "collide/device_collider.h"
#include "collide/parameters.h"
#include "geometry/bits.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

constexpr uint most_jump = 5;  // 4^5 tasks an entry
constexpr uint most_start_level = 12;

class Bvtt final : public DeviceCollider {
public:
    Bvtt(Programs& programs, const ColliderOptions& options)
        : DeviceCollider(programs,
                         {"bvtt", "Level-synchronous traversal with jumps [Chitalu2020, Sec. 5]"},
                         options, bvtt_group_size)
    {
        if (options.jump > most_jump)
            throw BadUsage("bvtt jumps at most " + std::to_string(most_jump) + " levels, not " +
                           std::to_string(options.jump));
        if (options.start_level > most_start_level)
            throw BadUsage("bvtt starts on level " + std::to_string(most_start_level) +
                           " at most, not " + std::to_string(options.start_level));
    }

    std::string refusal(const Tree& tree) const override
    {
        const auto* on_device = dynamic_cast<const DeviceTree*>(&tree);
        if (on_device != nullptr && !on_device->is_implicit() &&
            (options_.jump > 1 || options_.start_level > 0))
            return "bvtt can neither jump nor start below the root in a tree with pointers";
        if (on_device != nullptr &&
            (on_device->child_bits() * options_.jump > most_jump ||
             on_device->child_bits() * options_.start_level > most_start_level))
            return "bvtt jumps at most " + std::to_string(most_jump / on_device->child_bits()) +
                   " levels and starts on level " +
                   std::to_string(most_start_level / on_device->child_bits()) +
                   " at most where a node has " + std::to_string(1u << on_device->child_bits()) +
                   " children";
        if (on_device != nullptr && label_bits(*on_device) < 32 &&
            label_bits(*on_device) + ceil_log2(static_cast<uint>(on_device->objects.size())) > 32)
            return "bvtt names an object and its node in 32 bits, too few for " +
                   std::to_string(on_device->objects.size()) + " objects with labels of up to " +
                   std::to_string(on_device->label_bits()) + " bits";
        return DeviceCollider::refusal(tree);
    }

    QueryCounts counts(const Queue& queue) const override
    {
        QueryCounts counts = DeviceCollider::counts(queue);
        const std::vector<std::uint64_t> all = counters(queue);
        counts.bvtt_peak = std::max<std::uint64_t>(
            1, *std::max_element(all.begin() + QUEUES_COUNT / 2, all.end()));
        if (counts.tasks)
            counts.tasks = all[QUEUES_COUNT / 2];  // the pairs of roots it starts with
        return counts;
    }

private:
    /// What was asked for, else as the device is tuned where nodes have descendants by arithmetic, else 0. Tuned are
    /// levels of binary trees: as many of a wide one would be 2^48 pairs at once of 8 levels of 8 children.
    uint chosen(const DeviceTree& tree, uint asked, const Parameter& parameter) const
    {
        return asked != 0           ? asked
               : tree.is_implicit() ? device().tuned(parameter) / tree.child_bits()
                                    : 0;
    }

    /// Pairs of a work-item's own, of the form for few cores, for each of two lists.
    uint block_pairs() const { return device().tuned(bvtt_block_pairs); }
    /// Tasks a work-item has a turn, of the form for many lanes.
    uint items() const { return device().tuned(bvtt_items); }

    /// Levels each step descends. To start below the root is to jump there first.
    std::vector<uint> steps(const DeviceTree& tree) const
    {
        uint left = tree.most_levels() - 1;
        if (tree.objects.size() > 1)  // roots that are leaves meet in a step too
            left = std::max(left, 1u);
        std::vector<uint> steps;
        const uint start_level = chosen(tree, options_.start_level, bvtt_start_level);
        if (start_level > 0 && left > 0 && skips(skip_start_level))
            steps.push_back(std::min(start_level, left));
        const uint jump = std::max(1u, chosen(tree, options_.jump, bvtt_jump));
        for (left -= steps.empty() ? 0 : steps.front(); left > 0; left -= steps.back())
            steps.push_back(std::min(jump, left));
        return steps;
    }

    bool needs_ropes() const override { return false; }

    /// Of a node in a queue's entry; the object is in the rest.
    static uint label_bits(const DeviceTree& tree)
    {
        return tree.objects.size() > 1 && tree.is_implicit() ? tree.label_bits() : 32;
    }

    void compile(const DeviceTree& tree) override
    {
        const uint bits = label_bits(tree);
        const Define one_object{"ONE_OBJECT", tree.objects.size() == 1 ? 1u : 0u};
        const Define label{"LABEL_BITS", bits};
        if (tree.objects.size() > 1)
            roots_ = kernel(tree, "collide/queues/roots.cl", "find_roots",
                            {label,
                             {"SKIP_APART", skips(skip_apart) ? 1u : 0u},
                             {"OTHERS", others_a_work_item}});
        expand_ = by_groups()
                      ? kernel(tree, "collide/queues/bvtt_groups.cl", "expand",
                               {{"GROUP_SIZE", group_size_}, {"ITEMS", items()}, one_object, label})
                      : kernel(tree, "collide/queues/bvtt_chunks.cl", "expand",
                               {{"SINK_BLOCK", block_pairs()}, one_object, label});
        queue_capacity_ =
            options_.capacity != 0
                ? options_.capacity
                : device().room_for(std::max<std::size_t>(1024, 8 * std::size_t{tree.leaf_count()}),
                                    sizeof(Pair));
    }

    void plan(Arena& arena, const DeviceTree&) override
    {
        for (Buffer<Pair>& queue : queues_)
            queue = arena.take<Pair>(queue_capacity_, Use::scratch);
        if (!by_groups())
            blocks_ = arena.take<Pair>(2 * block_pairs() * chunks_, Use::scratch);
    }

    /// One a step, and what the last of them would leave.
    uint queue_count(const DeviceTree& tree) const override
    {
        return static_cast<uint>(steps(tree).size()) + 1;
    }

    bool make_room(std::uint64_t, const std::vector<std::uint64_t>& queue_sizes) override
    {
        // Entries that the last step left although it was not the last there is: all are launched next time.
        const bool ended = launched_ + 1 == queue_sizes.size() || queue_sizes[launched_] == 0;
        // One object's first entry, the root with itself, is in no queue.
        auto first_empty = queue_sizes.begin() + (has_one_object_ ? 1 : 0);
        first_empty = std::find(first_empty, queue_sizes.end(), 0u);
        needed_steps_ = ended ? static_cast<uint>(first_empty - queue_sizes.begin()) : all_steps;
        return has_room_for(queue_sizes) && ended;
    }

    bool has_room_for(const std::vector<std::uint64_t>& queue_sizes)
    {
        const std::uint64_t needed = *std::max_element(queue_sizes.begin(), queue_sizes.end());
        if (needed <= queue_capacity_)
            return true;
        constexpr std::uint64_t most = std::numeric_limits<uint>::max();
        if (needed > most)
            throw Unavailable(std::to_string(needed) + " pairs of nodes or more: a queue holds " +
                              std::to_string(most));
        // Steps behind the one that ran over have seen only some of their entries: they will need more.
        queue_capacity_ = device().room_for(std::min(most, 2 * needed), sizeof(Pair), needed);
        return false;
    }

    void enqueue(const DeviceTree& tree, const Input& input, Queue& queue) override
    {
        const bool one_object = tree.objects.size() == 1;
        has_one_object_ = one_object;
        if (one_object && !within())
            return;
        if (!one_object)
            find_roots(tree, queue);
        uint step = 0, depth = 0;
        for (const uint levels : steps(tree)) {
            if (step == needed_steps_ && skips(skip_empty_queue))
                break;
            const auto& from = queues_[step % 2];
            const auto& to = queues_[(step + 1) % 2];
            const auto room = static_cast<uint>(queue_capacity_);
            depth += tree.child_bits() * levels;
            if (by_groups()) {
                bind(expand_, tree, input, from, to, room, step, levels);
                // No more tasks than there are pairs of nodes that deep.
                const std::size_t most_tasks = std::size_t{1} << std::min(2 * depth, 40u);
                const std::size_t a_group = std::size_t{group_size_} * items();
                const std::size_t most_groups =
                    device().tuned(bvtt_groups_per_unit) *
                    std::size_t{device().cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()};
                const std::size_t groups =
                    !one_object ? most_groups
                                : std::min(most_groups, (most_tasks + a_group - 1) / a_group);
                queue.launch(expand_, groups * group_size_, group_size_, 0);
            } else {
                bind(expand_, tree, input, from, to, room, step, levels, blocks_);
                queue.launch(expand_, chunks_, 1, 0);
            }
            ++step;
        }
        launched_ = step;
    }

    void find_roots(const DeviceTree& tree, Queue& queue)
    {
        constexpr uint group = 64;
        const auto objects = static_cast<uint>(tree.objects.size());
        set_arguments_from(roots_, tree.bind(roots_, 0), objects, within() ? 1u : 0u,
                           between(tree) ? 1u : 0u, queues_[0], static_cast<uint>(queue_capacity_),
                           counters_);
        const std::size_t lanes = std::size_t{objects} * divided_up(objects, others_a_work_item);
        queue.launch(roots_, (lanes + group - 1) / group * group, group, 0);
    }

    static constexpr uint all_steps = std::numeric_limits<uint>::max();

    cl::Kernel roots_, expand_;
    bool has_one_object_ = false;
    uint launched_ = 0;              ///< steps of the last query
    uint needed_steps_ = all_steps;  ///< those of the query before that had something to expand
    std::size_t queue_capacity_ = 0;
    std::array<Buffer<Pair>, 2> queues_;  ///< of nodes; a step goes from one to the other
    Buffer<Pair> blocks_;
};

}  // namespace

std::unique_ptr<Collider> make_bvtt(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Bvtt>(programs, options);
}

}  // namespace bvhbench
