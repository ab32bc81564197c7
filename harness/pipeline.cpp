// SPDX-License-Identifier: MIT
#include "harness/pipeline.h"

#include "geometry/error.h"

namespace bvhbench {

Pipeline::Pipeline(Session& session, const BuilderChoice& builder, const ColliderChoice& collider,
                   const Input& input)
    : session_(session), choice_(builder), collider_(make_collider(collider, session.programs()))
{
    const Tree* tree = nullptr;
    if (collider_->needs_tree()) {
        if (collider_->keeps_tree())
            own_builder_ = make_builder(choice_, session.programs());
        builder_ = own_builder_ ? own_builder_.get()
                                : &session.builder(builder, Operation::collide);
        builder_->reserve_objects(object_sizes(input));
        session.build_once(*builder_, input, Start::from_triangles, &tree);
    }
    collider_->reserve(tree, input);
    if (collider.narrow != "none" && !collider_->finds_contacts()) {
        narrow_.emplace(session.programs(), NarrowOptions{.keep_adjacent = collider.keep_adjacent});
        narrow_->reserve(input.triangle_count());
    }
}

void Pipeline::enqueue(const Input& input)
{
    Queue& queue = session_.queue();
    const Tree* tree = nullptr;
    if (builder_ != nullptr)
        tree = update_ == TreeUpdate::refit ? &builder_->refit(input, queue)
                                            : &builder_->build(input, queue);
    collider_->query(tree, input, queue);
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
