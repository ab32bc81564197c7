// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "collide/counters.h"
#include "collide/device_collider.h"
#include "collide/device_lists.h"
#include "collide/front/front_plan.h"
#include "collide/parameters.h"
#include "collide/queues/node_pairs.h"

namespace bvhbench {
namespace {

constexpr uint all_steps = std::numeric_limits<uint>::max();

/// Number of entries (128 MiB) from which buffers grow by less: repeating a query costs less than the extra memory.
constexpr std::size_t many = std::size_t{1} << 24;

/// The current front is never written to: a query reads it and writes another one, and the next frame exchanges the two. So a
/// query that ran out of room, or is timed, can be repeated.
class Front final : public DeviceCollider {
public:
    Front(Programs& programs, const ColliderOptions& options)
        : DeviceCollider(programs,
                         {"front", "Front of pairs of nodes, over refitted boxes [Lauterbach2010]"},
                         options, front_group_size, Wants::tree)
    {
        if (options.jump > 1 || options.start_level > 0)
            throw BadUsage("front descends a level after the other and starts where it stands");
    }

    bool keeps_tree() const override { return true; }

    TreeUpdate next_frame() override
    {
        if (plan_.exchanges())
            std::swap(fronts_[0], fronts_[1]);
        const FrontStep before = plan_.step();
        const TreeUpdate update = plan_.next_frame();
        if (before != plan_.step())
            needed_steps_ = all_steps;
        return update;
    }

    QueryCounts counts(const Queue& queue) const override
    {
        QueryCounts counts = DeviceCollider::counts(queue);
        counts.tasks.reset();
        const std::vector<std::uint64_t> all = wide_counts(counters_, queue);
        const auto queues = all.begin() + FRONT_QUEUES_COUNT / 2 + 1;
        const std::uint64_t front = all[FRONT_COUNT / 2];
        counts.bvtt_peak = std::max(
            {front, std::uint64_t{plan_.standing()}, *std::max_element(queues, all.end())});
        counts.more = {{"front_count", front > 0 ? front : plan_.standing()},
                       {"sprouts_count", std::accumulate(queues, all.end(), std::uint64_t{0})},
                       {"prunes_count", all[PRUNES_COUNT / 2]},
                       {"restarts_count", plan_.restarts()}};
        return counts;
    }

private:
    std::string objection(const DeviceTree& tree) const override
    {
        return naming_objection("front", tree);
    }

    /// Number of entries of the initial front.
    std::uint64_t root_count() const
    {
        const std::uint64_t objects = object_count();
        return (within() ? objects : 0) + (between(objects) ? objects * (objects - 1) / 2 : 0);
    }

    /// Levels below the root: one step each, after step 0 over the front itself.
    uint descents() const { return tree().most_levels() - 1; }

    void compile(const Input&) override
    {
        const std::uint64_t roots = root_count();
        if (roots > most_entries)
            throw Unavailable(std::to_string(roots) + " pairs of objects: a front holds at most " +
                              std::to_string(most_entries));
        block_pairs_ = by_groups() ? 0 : node_pairs_in_block;
        queue_count_ = 3 + descents();  // front, prunes, and the output of each step
        const Define label{"LABEL_BITS", node_bits(tree())};
        advance_ =
            by_groups()
                ? kernel(
                      "collide/front/front_groups.cl", "advance",
                      {{"GROUP_SIZE", group_size_}, {"ITEMS", device().tuned(front_items)}, label},
                      Optimise::on_gpus)
                : kernel("collide/front/front_chunks.cl", "advance",
                         {{"SINK_BLOCK", block_pairs_}, label});
        roots_ = kernel("collide/queues/roots.cl", "list_roots", {label, {"SKIP_APART", 0}});
        if (!tree().is_implicit()) {
            list_parents_ = kernel("collide/front/front_parents.cl", "list_parents");
            cut_off_roots_ = kernel("collide/front/front_parents.cl", "cut_off_roots");
            list_depths_ = kernel("collide/front/front_parents.cl", "list_depths");
        }
        const std::size_t leaves = triangles_;
        queue_room_ = first_room(std::clamp<std::size_t>(8 * leaves, 1024, std::max(leaves, many)));
        front_room_ = std::max(queue_room_, static_cast<std::size_t>(roots));
        plan_.reset();
        needed_steps_ = all_steps;
    }

    void plan(Arena& arena) override
    {
        for (Buffer<Pair>& front : fronts_)
            front = arena.take<Pair>(front_room_, Use::scratch);
        for (Buffer<Pair>& queue : queues_)
            queue = arena.take<Pair>(queue_room_, Use::scratch);
        parents_ = arena.take<Pair>(tree().is_implicit() ? 1 : 2 * std::size_t{triangles_} - 1,
                                    Use::scratch);
        blocks_ = arena.take<Pair>(by_groups() ? 1 : 3 * block_pairs_ * chunks_, Use::scratch);
    }

    /// Saves the state that the frame starts from, which must survive a reallocation: the current front and the parents.
    void save(const cl::CommandQueue& queue) override
    {
        set_aside_.resize(plan_.standing());
        if (!set_aside_.empty())
            queue.enqueueReadBuffer(fronts_[0].cl(), CL_TRUE, 0, set_aside_.size() * sizeof(Pair),
                                    set_aside_.data());
        parents_aside_ = plan_.standing() > 0 && parents_.size() > 1 ? parents_.download(queue)
                                                                     : std::vector<Pair>{};
    }

    void fill(const cl::CommandQueue& queue) override
    {
        if (!set_aside_.empty())
            queue.enqueueWriteBuffer(fronts_[0].cl(), CL_TRUE, 0, set_aside_.size() * sizeof(Pair),
                                     set_aside_.data());
        if (!parents_aside_.empty())
            parents_.upload(queue, parents_aside_);
        set_aside_ = {};
        parents_aside_ = {};
        plan_.incomplete();
    }

    bool make_room(std::uint64_t, const std::vector<std::uint64_t>& sizes) override
    {
        constexpr std::size_t queues = (FRONT_QUEUES_COUNT - QUEUES_COUNT) / 2 + 1;
        const auto first = sizes.begin() + queues;
        // False if the last step launched left entries although the tree has more steps; then the next query launches all steps.
        const bool ended = launched_ == 0 || launched_ > descents() || first[launched_ - 1] == 0;
        needed_steps_ =
            ended ? static_cast<uint>(std::find(first, sizes.end(), 0u) - first) + 1 : all_steps;
        const std::uint64_t waiting = *std::max_element(first, sizes.end());
        // Steps after an overflow have seen only some of their entries, so they, and the front, will need more.
        const bool queues_fit =
            had_room(queue_room_, waiting, waiting < many ? waiting : waiting / 16, sizeof(Pair),
                     device(), "pairs of nodes");
        const std::uint64_t front = sizes.front();
        const bool front_fits = had_room(front_room_, front, front / (front < many ? 4 : 16),
                                         sizeof(Pair), device(), "pairs of nodes");
        if (!ended || !queues_fit || !front_fits)
            return false;
        const std::uint64_t tests_a_node = std::uint64_t{1} << (2 * tree().child_bits());
        plan_.complete(static_cast<uint>(front),
                       tests_a_node * std::accumulate(first, sizes.end(), std::uint64_t{0}));
        return true;
    }

    /// Bytes of the current front. How much of the tree a frame reads beyond it depends on the front.
    std::int64_t reads_at_least() const override
    {
        return std::int64_t{plan_.standing()} * std::int64_t{sizeof(Pair)};
    }

    void enqueue(const Input& input, Queue& queue) override
    {
        const bool from_roots = plan_.step() == FrontStep::generate;
        if (from_roots)
            start_from_roots(queue);
        const uint standing = from_roots ? static_cast<uint>(root_count()) : plan_.standing();
        for (launched_ = 0; launched_ <= descents(); ++launched_) {
            const uint step = launched_;
            if (step == needed_steps_ && skips(skip_empty_queue))
                break;
            const Buffer<Pair>& from = step == 0 ? fronts_[0] : queues_[step % 2];
            bind(advance_, input, parents_, from, queues_[(step + 1) % 2],
                 static_cast<uint>(queue_room_), fronts_[1], static_cast<uint>(front_room_), step,
                 standing, plan_.writes() ? 1u : 0u, blocks_);
            // In binary trees, an entry has 4 pairs of children per level.
            const std::size_t tasks = std::size_t{standing}
                                      << std::min(2 * tree().child_bits() * step, 30u);
            if (by_groups())
                launch(advance_,
                       group_count(device(), tasks,
                                   std::size_t{group_size_} * device().tuned(front_items)) *
                           group_size_,
                       group_size_, queue);
            else
                launch(advance_, chunks_, 1, queue);
        }
    }

    void start_from_roots(Queue& queue)
    {
        constexpr std::size_t group = 64;
        const uint objects = object_count();
        set_arguments_from(roots_, tree().bind(roots_, 0), objects, within() ? 1u : 0u,
                           between(objects) ? 1u : 0u, fronts_[0]);
        launch(roots_, std::size_t{objects} * objects, group, queue);
        if (tree().is_implicit())
            return;
        const std::size_t items = by_groups() ? triangles_ : chunks_;
        set_arguments_from(list_parents_, tree().bind(list_parents_, 0), parents_);
        launch(list_parents_, items, group, queue);
        set_arguments_from(cut_off_roots_, tree().bind(cut_off_roots_, 0), parents_, objects);
        launch(cut_off_roots_, objects, group, queue);
        set_arguments_from(list_depths_, tree().bind(list_depths_, 0), parents_);
        launch(list_depths_, items, group, queue);
    }

    cl::Kernel advance_, roots_, list_parents_, cut_off_roots_, list_depths_;
    uint block_pairs_ = 0;  ///< entries per block, in the chunk form
    std::size_t queue_room_ = 0, front_room_ = 0;
    std::array<Buffer<Pair>, 2> fronts_;  ///< the current one, and the one that the query writes
    std::array<Buffer<Pair>, 2> queues_;  ///< sprouted pairs: read and written by turns
    Buffer<Pair> parents_;                ///< see front_parents.cl; one element if not needed
    Buffer<Pair> blocks_;                 ///< blocks of the chunk form
    std::vector<Pair> set_aside_, parents_aside_;

    FrontPlan plan_;
    uint launched_ = 0;              ///< steps launched by the last query
    uint needed_steps_ = all_steps;  ///< steps that had tasks in the last query
};

}  // namespace

std::unique_ptr<Collider> make_front(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Front>(programs, options);
}

}  // namespace bvhbench
