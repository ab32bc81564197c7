// SPDX-License-Identifier: MIT
#include "harness/pipeline.h"

#include <algorithm>

#include "geometry/error.h"

namespace bvhbench {

Pipeline::Pipeline(Session& session, const BuilderChoice& builder, const ColliderChoice& collider,
                   const Input& input)
    : session_(session)
    , choice_(builder)
    , rules_off_(collider.rules_off)
    , collider_(make_collider(collider, session.programs()))
{
    if (collider_->needs_tree()) {
        builder_ = make_builder(choice_, session.programs());
        builder_->reserve_objects(object_sizes(input));
        session.build_once(*builder_, input, Start::from_triangles, &tree_);
    }
    collider_->reserve(tree_, input);
    if (collider.narrow != "none" && !collider_->finds_contacts()) {
        narrow_.emplace(session.programs(), NarrowOptions{.keep_adjacent = collider.keep_adjacent});
        narrow_->reserve(input.triangle_count());
    }
}

TreeUpdate Pipeline::begin_frame(std::span<const Motion> motions)
{
    const auto all_are = [&](Motion most) {
        return !motions.empty() && std::all_of(motions.begin(), motions.end(),
                                               [&](Motion motion) { return motion <= most; });
    };
    const auto skips = [&](SkipRule rule) { return (rules_off_ & rule) == 0; };
    if (collider_->keeps_tree())
        update_ = collider_->next_frame();
    else if (builder_ != nullptr && skips(skip_unchanged) && all_are(Motion::unchanged))
        update_ = TreeUpdate::keep;
    else if (builder_ != nullptr && skips(skip_rigid) && builder_->can_refit() &&
             all_are(Motion::rigid))
        update_ = TreeUpdate::refit;
    else
        update_ = TreeUpdate::rebuild;
    return update_;
}

void Pipeline::enqueue(const Input& input)
{
    Queue& queue = session_.queue();
    if (builder_ != nullptr && update_ != TreeUpdate::keep)
        tree_ = update_ == TreeUpdate::refit ? &builder_->refit(input, queue)
                                             : &builder_->build(input, queue);
    collider_->query(tree_, input, queue);
    if (!narrow_)
        return;
    const DevicePairs found = collider_->device_pairs(queue);
    narrow_->query(input, found.pairs, found.counters, queue);
}

bool Pipeline::complete()
{
    const Queue& queue = session_.queue();
    return collider_->complete(queue) && (!narrow_ || narrow_->complete(queue));
}

void Pipeline::settle(const Input& input)
{
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

PairList Pipeline::pairs() const { return PairList(collider_->pairs(session_.queue())); }

PairList Pipeline::contacts() const
{
    return narrow_ ? PairList(narrow_->contacts(session_.queue())) : pairs();
}

std::map<std::string, double> Pipeline::counters() const
{
    std::map<std::string, double> counters;
    const auto put = [&](const char* name, auto value) {
        counters[name] = static_cast<double>(value);
    };
    const Queue& queue = session_.queue();
    const QueryCounts counts = collider_->counts(queue);
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
        put("rebuilds_count", update_ == TreeUpdate::rebuild ? 1 : 0);
        memory += tree.total();
    }
    if (narrow_) {
        const NarrowCounts narrow = narrow_->counts(queue);
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
