// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "builders/stages/scan.h"
#include "collide/counters.h"
#include "collide/device_collider.h"
#include "collide/device_lists.h"
#include "collide/front/front_plan.h"
#include "collide/parameters.h"
#include "collide/queues/node_pairs.h"

namespace bvhbench {
namespace {

/// Number of entries (128 MiB) from which buffers grow by less: repeating a query costs less than the extra memory.
constexpr std::size_t many_entries = std::size_t{1} << 24;

/// Bins per leaf for ordering; see leaf_front_bins.clh.
constexpr std::size_t bins_per_leaf = 4;

/// Entries that a work-item buffers in the form for few cores.
constexpr uint front_block = 512;

/// The current front is never written to: a query reads it and may write another one, and the next frame exchanges the two. So a
/// query that ran out of room, or is timed, can be repeated.
class LeafFront final : public DeviceCollider {
public:
    LeafFront(Programs& programs, const ColliderOptions& options)
        : DeviceCollider(
              programs, {"front-leaf", "Front of leaves and nodes, over refitted boxes [Wang2018]"},
              options, leaf_front_group_size, Wants::tree_with_ropes)
        , scan_(programs, options.form)
    {
        if (options.jump > 1 || options.start_level > 0)
            throw BadUsage(
                "front-leaf descends a level after the other and starts where it stands");
    }

    bool keeps_tree() const override { return true; }

    TreeUpdate next_frame() override
    {
        if (plan_.exchanges())
            std::swap(fronts_[0], fronts_[1]);
        return plan_.next_frame();
    }

    QueryCounts counts(const Queue& queue) const override
    {
        QueryCounts counts = DeviceCollider::counts(queue);
        counts.tasks.reset();
        const std::vector<std::uint64_t> all = wide_counts(counters_, queue);
        const std::uint64_t written = all[FRONT_COUNT / 2];
        counts.bvtt_peak = std::max<std::uint64_t>(written, plan_.standing());
        counts.more = {{"front_count", written > 0 ? written : plan_.standing()},
                       {"descents_count", all[DESCENTS_COUNT / 2]},
                       {"prunes_count", all[PRUNES_COUNT / 2]},
                       {"restarts_count", plan_.restarts()}};
        return counts;
    }

private:
    std::string objection(const DeviceTree& tree) const override
    {
        if (tree.child_bits() > 1)
            return "front-leaf needs a binary tree: a wide one has no boxes of single nodes";
        return naming_objection("front-leaf", tree);
    }

    bool keeps_ropes() const override { return plan_.step() != FrontStep::generate; }

    void compile(const Input&) override
    {
        queue_count_ = 3;  // entries written, prunes, descents
        is_ordered_ = device().tuned(leaf_front_ordered) != 0;
        const std::vector<Define> defines = {
            {"LABEL_BITS", node_bits(tree())},
            {"ORDERED", is_ordered_ ? 1u : 0u},
            by_groups() ? Define{"GROUP_SIZE", group_size_} : Define{"SINK_BLOCK", front_block}};
        const char* path = by_groups() ? "collide/front/leaf_front_groups.cl"
                                       : "collide/front/leaf_front_chunks.cl";
        advance_ = kernel(path, "advance", defines);
        generate_ = kernel(path, "generate", defines);
        if (is_ordered_)
            order_ =
                kernel("collide/front/leaf_front_order.cl", "order_entries", {defines.front()});
        if (!tree().is_implicit()) {
            list_parents_ = kernel("collide/front/front_parents.cl", "list_parents");
            cut_off_roots_ = kernel("collide/front/front_parents.cl", "cut_off_roots");
        }
        front_room_ = first_room(std::clamp<std::size_t>(
            16 * std::size_t{triangles_}, 1024, std::max<std::size_t>(triangles_, many_entries)));
        plan_.reset();
    }

    void plan(Arena& arena) override
    {
        for (Buffer<Pair>& front : fronts_)
            front = arena.take<Pair>(front_room_, Use::scratch);
        parents_ = arena.take<Pair>(tree().is_implicit() ? 1 : 2 * std::size_t{triangles_} - 1,
                                    Use::scratch);
        blocks_ = arena.take<Pair>(by_groups() ? 1 : 2 * front_block * chunks_, Use::scratch);
        bins_ = arena.take<uint>(is_ordered_ ? bins_per_leaf * triangles_ : 1, Use::scratch);
        if (!is_ordered_)
            return;
        unordered_ = arena.take<Pair>(front_room_, Use::scratch);
        scan_.plan(arena, bins_.size());
    }

    /// Saves the current front, from which the frame starts. Parents are listed again.
    void save(const cl::CommandQueue& queue) override
    {
        set_aside_.resize(plan_.standing());
        if (!set_aside_.empty())
            queue.enqueueReadBuffer(fronts_[0].cl(), CL_TRUE, 0, set_aside_.size() * sizeof(Pair),
                                    set_aside_.data());
    }

    void fill(const cl::CommandQueue& queue) override
    {
        if (!set_aside_.empty())
            queue.enqueueWriteBuffer(fronts_[0].cl(), CL_TRUE, 0, set_aside_.size() * sizeof(Pair),
                                     set_aside_.data());
        set_aside_ = {};
        has_parents_ = false;
        plan_.incomplete();
    }

    bool make_room(std::uint64_t, const std::vector<std::uint64_t>& sizes) override
    {
        const std::uint64_t front = sizes.front();
        if (!had_room(front_room_, front, front / (front < many_entries ? 4 : 16), sizeof(Pair),
                      device(), "entries of a front"))
            return false;
        plan_.complete(static_cast<uint>(front), sizes[(DESCENTS_COUNT - QUEUES_COUNT) / 2]);
        return true;
    }

    /// Bytes of the current front. How much of the tree a frame reads beyond it depends on the front.
    std::int64_t reads_at_least() const override
    {
        return std::int64_t{plan_.standing()} * std::int64_t{sizeof(Pair)};
    }

    void enqueue(const Input& input, Queue& queue) override
    {
        if (!tree().is_implicit() && (plan_.step() == FrontStep::generate || !has_parents_))
            list_parents(queue);
        const bool writes = plan_.writes(), orders = writes && is_ordered_;
        const uint standing = plan_.standing();
        if (orders)
            queue.clear(bins_.cl(), bins_.bytes());
        const Buffer<Pair>& written = orders ? unordered_ : fronts_[1];
        const auto room = static_cast<uint>(front_room_);
        if (plan_.step() == FrontStep::generate) {
            bind(generate_, input, written, room, bins_, triangles_, object_count(),
                 within() ? 1u : 0u, between(object_count()) ? 1u : 0u, blocks_);
            launch_over(generate_, std::size_t{triangles_} * object_count(), queue);
        } else if (standing > 0) {
            bind(advance_, input, written, room, bins_, fronts_[0], standing, parents_,
                 writes ? 1u : 0u, blocks_);
            launch_over(advance_, standing, queue);
        }
        if (!orders)
            return;
        scan_.enqueue(bins_, queue);
        set_arguments_from(order_, tree().bind(order_, 0), unordered_, room, counters_, bins_,
                           fronts_[1]);
        launch(order_, by_groups() ? std::max(standing, triangles_) : chunks_,
               by_groups() ? group_size_ : 1, queue);
    }

    void launch_over(const cl::Kernel& kernel, std::size_t items, Queue& queue)
    {
        launch(kernel, by_groups() ? items : chunks_, by_groups() ? group_size_ : 1, queue);
    }

    void list_parents(Queue& queue)
    {
        constexpr std::size_t group = 64;
        const uint objects = object_count();
        set_arguments_from(list_parents_, tree().bind(list_parents_, 0), parents_);
        launch(list_parents_, by_groups() ? triangles_ : chunks_, group, queue);
        set_arguments_from(cut_off_roots_, tree().bind(cut_off_roots_, 0), parents_, objects);
        launch(cut_off_roots_, objects, group, queue);
        has_parents_ = true;
    }

    ScanStage scan_;
    cl::Kernel advance_, generate_, order_, list_parents_, cut_off_roots_;
    bool is_ordered_ = false;
    std::size_t front_room_ = 0;
    std::array<Buffer<Pair>, 2> fronts_;  ///< the current one, and the one that the query writes
    Buffer<Pair> unordered_;              ///< entries before they are ordered
    Buffer<uint> bins_;                   ///< entries per node, then their places
    Buffer<Pair> parents_;                ///< see front_parents.cl; one element if not needed
    Buffer<Pair> blocks_;                 ///< blocks of the chunk form
    std::vector<Pair> set_aside_;
    bool has_parents_ = false;
    FrontPlan plan_;
};

}  // namespace

std::unique_ptr<Collider> make_leaf_front(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<LeafFront>(programs, options);
}

}  // namespace bvhbench
