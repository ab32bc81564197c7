// SPDX-License-Identifier: MIT
#include "harness/pipeline.h"

#include <algorithm>
#include <numeric>

#include "geometry/error.h"

namespace bvhbench {

Pipeline::Pipeline(Session& session, const BuilderChoice& builder, const ColliderChoice& collider,
                   const Input& input)
    : session_(session)
    , choice_(builder)
    , rules_off_(collider.rules_off)
    , collider_(make_collider(collider, session.programs()))
{
    if (collider_->needs_tree())
        builder_ = make_builder(choice_, session.programs());
    reserve_for(input);
    if (collider.narrow != "none" && !collider_->finds_contacts()) {
        narrow_.emplace(session.programs(), NarrowOptions{.keep_adjacent = collider.keep_adjacent});
        narrow_->reserve(input.triangle_count());
    }
    if (skips(skip_near) && collider.among == Among::between_objects && input.objects.size() > 1 &&
        builder_ != nullptr && !collider_->keeps_tree() &&
        NearTriangles::may_pay(session.device(), input.triangle_count())) {
        near_.emplace(session.programs(), NearOptions{});
        near_->reserve(input);
    }
}

void Pipeline::reserve_for(const Input& input)
{
    if (builder_ != nullptr) {
        builder_->reserve_objects(object_sizes(input));
        session_.build_once(*builder_, input, Start::from_triangles, &tree_);
    }
    collider_->reserve(tree_, input);
}

TreeUpdate Pipeline::begin_frame(std::span<const Motion> motions)
{
    const auto all_are = [&](Motion most) {
        return !motions.empty() && std::all_of(motions.begin(), motions.end(),
                                               [&](Motion motion) { return motion <= most; });
    };
    if (collider_->keeps_tree())
        update_ = collider_->next_frame();
    else if (builder_ != nullptr && skips(skip_unchanged) && queries() &&
             all_are(Motion::unchanged))
        update_ = TreeUpdate::keep;
    else if (builder_ != nullptr && skips(skip_rigid) && !entering_ && builder_->can_refit() &&
             all_are(Motion::rigid))
        update_ = TreeUpdate::refit;
    else
        update_ = TreeUpdate::rebuild;
    return update_;
}

/// Memory is for as many triangles as enter, and to know how many they are takes the device's work of a frame. So it is
/// found out here, where nothing is timed, whether this frame is worth it; a simulation would go by the frame before.
void Pipeline::choose_entering(const Input& input)
{
    if (!near_ || update_ != TreeUpdate::rebuild)
        return;
    Queue& queue = session_.queue();
    std::vector<uint> counts = near_->find(input, queue);
    queue.finish();
    const std::size_t total = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
    if (total > NearTriangles::most_of(input.triangle_count())) {
        if (entering_)
            reserve_for(input);
        entering_.reset();
        return;
    }
    const bool has_memory = entering_ && entering_->counts == counts;
    entering_.emplace();
    entering_->input = near_->frame(input, counts, entering_->faces, queue);
    entering_->counts = std::move(counts);
    if (!has_memory && entering_->has_pairs())
        reserve_for(entering_->input);
}

void Pipeline::enqueue(const Input& input)
{
    Queue& queue = session_.queue();
    if (!entering_) {
        enqueue_query(input);
    } else {
        if (update_ != TreeUpdate::keep && near_->find(input, queue) != entering_->counts)
            throw Unavailable("other triangles enter the frame than when memory was taken for it");
        if (!entering_->has_pairs())
            return;
        entering_->input.points = input.points;
        enqueue_query(entering_->input);
        near_->map_back(collider_->device_pairs(queue), queue);
    }
    if (!narrow_)
        return;
    const DevicePairs found = collider_->device_pairs(queue);
    narrow_->query(input, found.pairs, found.counters, queue);
}

void Pipeline::enqueue_query(const Input& input)
{
    Queue& queue = session_.queue();
    if (builder_ != nullptr && update_ != TreeUpdate::keep)
        tree_ = update_ == TreeUpdate::refit ? &builder_->refit(input, queue)
                                             : &builder_->build(input, queue);
    collider_->query(tree_, input, queue);
}

bool Pipeline::complete()
{
    const Queue& queue = session_.queue();
    return !queries() || (collider_->complete(queue) && (!narrow_ || narrow_->complete(queue)));
}

void Pipeline::settle(const Input& input)
{
    choose_entering(input);
    do {
        enqueue(input);
        session_.queue().finish();
    } while (!complete());
}

std::vector<StageTime> Pipeline::once(const Input& input)
{
    enqueue(input);
    std::vector<StageTime> stages = session_.queue().finish();
    if (!complete())
        throw Unavailable("a query found more than the one before it over the same triangles");
    return stages;
}

PairList Pipeline::pairs() const
{
    return queries() ? PairList(collider_->pairs(session_.queue())) : PairList();
}

PairList Pipeline::contacts() const
{
    return narrow_ && queries() ? PairList(narrow_->contacts(session_.queue())) : pairs();
}

std::map<std::string, double> Pipeline::counters() const
{
    std::map<std::string, double> counters;
    const auto put = [&](const char* name, auto value) {
        counters[name] = static_cast<double>(value);
    };
    const Queue& queue = session_.queue();
    QueryCounts counts;
    if (queries())
        counts = collider_->counts(queue);
    else
        counts.box_tests = counts.tasks = 0;
    if (entering_ && update_ != TreeUpdate::keep)
        *counts.box_tests += near_->box_tests(queue);
    put(collider_->finds_contacts() ? "contacts_count" : "pairs_count", counts.pairs);
    if (counts.box_tests)
        put("box_tests_count", *counts.box_tests);
    if (counts.bvtt_peak)
        put("bvtt_peak_count", *counts.bvtt_peak);
    if (counts.tasks)
        put("tasks_count", *counts.tasks);
    for (const auto& [name, value] : counts.more)
        put(std::string(name).c_str(), value);
    std::size_t memory = collider_->reserved().total();
    put("query_bytes", memory);
    if (builder_ != nullptr) {
        const Footprint tree = builder_->reserved();
        put("tree_bytes", tree.tree_bytes);
        put("scratch_bytes", tree.scratch_bytes);
        put("refits_count", update_ == TreeUpdate::refit ? 1 : 0);
        put("rebuilds_count", update_ == TreeUpdate::rebuild && queries() ? 1 : 0);
        memory += tree.total();
    }
    if (entering_)
        put("entered_count", entering_->input.triangle_count());
    if (near_) {
        put("near_bytes", near_->reserved().total());
        memory += near_->reserved().total();
    }
    if (narrow_) {
        const NarrowCounts narrow = queries() ? narrow_->counts(queue) : NarrowCounts{};
        put("contacts_count", narrow.contacts);
        put("narrow_float_count", narrow.by_floats);
        put("narrow_double_count", narrow.by_doubles);
        put("narrow_exact_count", narrow.exactly);
        put("narrow_bytes", narrow_->reserved().total());
        memory += narrow_->reserved().total();
    }
    put("memory_bytes", memory);
    return counters;
}

}  // namespace bvhbench
