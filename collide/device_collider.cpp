// SPDX-License-Identifier: MIT
#include "collide/device_collider.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

#include "collide/counters.h"
#include "collide/device_lists.h"
#include "collide/object_order.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

/// Largest work-group size: local memory per group grows with it, and this many work-items fit into 48 KB.
constexpr std::size_t most_group_size = 256;

/// Most leaves of a tree that is queried. Of one leaf more, the last would have the largest label of 32 bits, after which walks go
/// on with 0; in a radix tree it would be TREE_NONE.
constexpr uint most_leaves = (1u << 31) - 1;

uint chosen_group_size(const Device& device, KernelForm form, unsigned asked,
                       const Parameter& usual)
{
    const std::size_t most = std::min<std::size_t>(
        most_group_size, std::bit_floor(device.cl.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>()));
    if (asked == 0 && chosen_form(device, form) == KernelForm::chunks)
        return 1;  // in the chunk form, a work-group is one work-item
    if (asked == 0)
        return static_cast<uint>(std::min<std::size_t>(device.tuned(usual), most));
    if (!std::has_single_bit(asked) || asked > most || asked < usual.least)
        throw BadUsage("a collider's group size is a power of two from " +
                       std::to_string(usual.least) + " up to " + std::to_string(most) + " on " +
                       device.name() + ", not " + std::to_string(asked));
    return asked;
}

}  // namespace

int find_pairs(Collider& collider, const Tree* tree, const Input& input, Queue& queue)
{
    for (int queries = 1;; ++queries) {
        collider.query(tree, input, queue);
        if (collider.complete(queue))
            return queries;
    }
}

DeviceCollider::DeviceCollider(Programs& programs, const ColliderCard& card,
                               const ColliderOptions& options, const Parameter& group_size,
                               Wants wants)
    : options_(options)
    , group_size_(
          chosen_group_size(programs.device(), options.form, options.group_size, group_size))
    , chunks_(chunk_count(programs.device()))
    , programs_(programs)
    , card_(card)
    , wants_(wants)
    , form_(chosen_form(programs.device(), options.form))
{}

std::string DeviceCollider::refusal(const Tree& tree) const
{
    if (!needs_tree())
        return {};
    const auto* on_device = dynamic_cast<const DeviceTree*>(&tree);
    if (on_device == nullptr)
        return std::string(card_.name) + " needs a tree in device memory";
    if (on_device->leaf_count() > most_leaves)
        return std::string(card_.name) + " numbers nodes by 32 bits, for up to " +
               std::to_string(most_leaves) + " leaves, not " +
               std::to_string(on_device->leaf_count());
    if (std::string why = objection(*on_device); !why.empty())
        return why;
    if (follows_pointers(*on_device) && device().ends_loops)
        return std::string(card_.name) + " follows pointers of a tree in loops that " +
               device().name() + " ends early";
    return {};
}

cl::Kernel DeviceCollider::kernel(std::string_view path, const char* name, std::vector<Define> more,
                                  Optimise optimise) const
{
    more.push_back({"SORTED_LEAVES", tree().has_sorted_leaves() ? 1u : 0u});
    more.push_back({"BOX_FORMAT", tree().box_format().number});
    more.push_back({"KEEP_ADJACENT", options_.keep_adjacent ? 1u : 0u});
    return programs().kernel(tree().access_header(), path, name, more, optimise);
}

std::unique_ptr<ObjectOrder> DeviceCollider::object_order(const Input& input) const
{
    const bool is_useful = between(object_count()) && skips(skip_apart) &&
                           object_count() >= ObjectOrder::least_objects(form_);
    if (is_filtered() ? object_count() == 1 : !is_useful)
        return {};
    FilterTables tables;
    if (is_filtered())
        tables = tables_of(options_.filter, object_count());
    return std::make_unique<ObjectOrder>(
        programs(), form_, kernel("collide/object_order.cl", "begin_objects"),
        kernel("collide/object_order.cl", "place_objects"), input, std::move(tables));
}

void DeviceCollider::reserve(const Tree* tree, const Input& input)
{
    triangles_ = input.triangle_count();
    if (needs_tree()) {
        assert(tree != nullptr);
        if (const std::string why = refusal(*tree); !why.empty())
            throw BadUsage(why);
        tree_ = dynamic_cast<const DeviceTree*>(tree);
        triangles_ = tree_->leaf_count();
        options_.filter.check(object_count());
        if (has_ropes(*tree_))
            ropes_kernel_ = kernel("collide/walks/ropes.cl", "ropes");
    }
    compile(input);
    pair_room_ =
        options_.first ? 1 : first_room(std::max<std::size_t>(1024, first_pairs_each * triangles_));
    take_all();
}

std::size_t DeviceCollider::first_room(std::size_t guess, std::size_t entry_bytes) const
{
    return options_.capacity != 0
               ? options_.capacity
               : device().room_for(std::min<std::size_t>(guess, most_entries), entry_bytes);
}

void DeviceCollider::take_all()
{
    const cl::CommandQueue queue(device().context, device().cl);
    if (arena_)
        save(queue);
    take_memory(arena_, device(), [&](Arena& arena) {
        counters_ = arena.take<uint>(QUEUES_COUNT + 2 * queue_count_, Use::scratch);
        next_counters_ = arena.take<uint>(zeroes_next_ ? counters_.size() : 0, Use::scratch);
        const bool with_ropes = tree_ != nullptr && has_ropes(*tree_);
        ropes_ = arena.take<uint>(with_ropes ? 2 * std::size_t{triangles_} - 1 : 1, Use::scratch);
        has_written_ropes_ = false;
        pairs_ = arena.take<Pair>(pair_room_, Use::scratch);
        plan(arena);
    });
    for (Buffer<uint>* zeroed : {&counters_, &next_counters_})
        zeroed->upload(queue, std::vector<uint>(zeroed->size()));
    fill(queue);
}

void DeviceCollider::query(const Tree* tree, const Input& input, Queue& queue)
{
    counts_.clear();
    if (needs_tree())
        tree_ = &dynamic_cast<const DeviceTree&>(*tree);
    assert(arena_ && triangles_ == (needs_tree() ? tree_->leaf_count() : input.triangle_count()));
    const bool has_pairs = triangles_ > 1;
    if (has_pairs && needs_tree() && has_ropes(*tree_) && !(has_written_ropes_ && keeps_ropes())) {
        has_written_ropes_ = true;
        queue.begin("ropes");
        set_arguments_from(ropes_kernel_, tree_->bind(ropes_kernel_, 0), ropes_);
        launch(
            ropes_kernel_, by_groups() ? triangles_ : chunks_, by_groups() ? group_size_ : 1, queue,
            2 * static_cast<std::int64_t>(ropes_.bytes()));  // reads each child, writes each rope
    }
    if (has_pairs)
        enqueue_before(input, queue);
    queue.begin("broad");
    if (zeroes_next_ && has_pairs)
        std::swap(counters_, next_counters_);
    else
        queue.clear(counters_.cl(), counters_.bytes());
    queue.declare(has_pairs ? reads_at_least() : 0);
    if (has_pairs)
        enqueue(input, queue);
}

std::int64_t DeviceCollider::reads_at_least() const
{
    if (!within() || is_filtered() || options_.first)  // hardly anything may have to be read
        return 0;
    const std::int64_t leaves = triangles_, nodes = 2 * leaves - std::ssize(tree_->objects);
    return nodes * static_cast<std::int64_t>(tree_->box_format().box_bytes()) +
           leaves * std::int64_t{sizeof(uint)};
}

bool DeviceCollider::complete(const Queue& queue)
{
    std::vector<std::uint64_t> counts = wide_counts(counters_, queue);
    const std::uint64_t found = counts[PAIRS_COUNT / 2];
    const bool pairs_fit = had_room(pair_room_, found, found / 8, sizeof(Pair), device(), "pairs");
    const bool rest_fits =
        make_room(counts[TASKS_COUNT / 2], {counts.begin() + QUEUES_COUNT / 2, counts.end()});
    if (pairs_fit && rest_fits)
        counts_ = std::move(counts);
    else
        take_all();
    return pairs_fit && rest_fits;
}

QueryCounts DeviceCollider::counts(const Queue& queue) const
{
    const std::vector<std::uint64_t> counts =
        counts_.empty() ? wide_counts(counters_, queue) : counts_;
    QueryCounts result = {counts[PAIRS_COUNT / 2], counts[BOX_TESTS_COUNT / 2], {}, {}};
    if (needs_tree() && object_count() > 1)
        result.tasks = counts[TASKS_COUNT / 2];
    return result;
}

std::vector<Pair> DeviceCollider::pairs(const Queue& queue) const
{
    return first_entries(pairs_, DeviceCollider::counts(queue).pairs, queue, "the pairs found");
}

}  // namespace bvhbench
