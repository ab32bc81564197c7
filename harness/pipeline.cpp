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
    , updates_(input.objects.size(), TreeUpdate::rebuild)
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

TreeUpdate Pipeline::update_after(Motion motion) const
{
    const auto skips = [&](SkipRule rule) { return (rules_off_ & rule) == 0; };
    if (skips(skip_unchanged) && motion == Motion::unchanged)
        return TreeUpdate::keep;
    return skips(skip_rigid) && motion <= Motion::rigid && builder_->can_refit()
               ? TreeUpdate::refit
               : TreeUpdate::rebuild;
}

void Pipeline::begin_frame(std::span<const Motion> motions)
{
    Queue& queue = session_.queue();
    std::vector<TreeUpdate> wanted(updates_.size(), TreeUpdate::rebuild);
    if (collider_->keeps_tree())
        wanted.assign(wanted.size(), collider_->next_frame());
    if (builder_ == nullptr)
        return;
    if (trials_.is_trying())
        trials_.learn(!builder_->lined_up_anew(queue));
    bool try_order = false;
    if (!collider_->keeps_tree() && !motions.empty()) {
        std::transform(motions.begin(), motions.end(), wanted.begin(),
                       [&](Motion motion) { return update_after(motion); });
        try_order = (rules_off_ & skip_sorted) == 0 &&
                    std::count(wanted.begin(), wanted.end(), TreeUpdate::rebuild) > 0 &&
                    trials_.next();
    }
    updates_ = builder_->plan_update(wanted, try_order, queue);
}

std::size_t Pipeline::updated(TreeUpdate how) const
{
    return static_cast<std::size_t>(std::count(updates_.begin(), updates_.end(), how));
}

void Pipeline::enqueue(const Input& input)
{
    Queue& queue = session_.queue();
    if (builder_ != nullptr && updated(TreeUpdate::keep) < updates_.size())
        tree_ = &builder_->update(input, queue);
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
        put("rebuilt_objects_count", updated(TreeUpdate::rebuild));
        put("refitted_objects_count", updated(TreeUpdate::refit));
        put("kept_objects_count", updated(TreeUpdate::keep));
        put("sorts_count", builder_->lined_up_anew(queue) ? 1 : 0);
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
