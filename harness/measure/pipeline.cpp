// SPDX-License-Identifier: MIT
#include "harness/measure/pipeline.h"

#include <algorithm>
#include <numeric>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/judge/pair_counts.h"
#include "harness/measure/engine.h"

namespace bvhbench {
namespace {

constexpr std::int64_t most_copying_ns = 200'000'000;  ///< after which a copy is not timed again

}  // namespace

Pipeline::Pipeline(Session& session, const BuilderChoice& builder, const ColliderChoice& collider,
                   const Input& input)
    : session_(session)
    , choice_(builder)
    , rules_off_(collider.rules_off)
    , updates_(input.objects.size(), TreeUpdate::rebuild)
    , collider_(make_collider(collider, session.programs()))
{
    if (input.is_swept() && (collider.narrow != "none" || collider_->finds_contacts()))
        throw BadUsage(
            std::string("swept boxes tell who may meet between two frames, not who does: ") +
            (collider_->finds_contacts() ? "the collider " + collider.name
                                         : "a narrow phase, " + collider.narrow + ",") +
            " looks at one moment");
    if (collider_->needs_tree())
        builder_ = make_builder(choice_, session.programs());
    reserve_for(input);
    if (collider.narrow != "none" && !collider_->finds_contacts()) {
        narrow_.emplace(session.programs(), NarrowOptions{.method = collider.narrow,
                                                          .keep_adjacent = collider.keep_adjacent,
                                                          .form = collider.form});
        narrow_->reserve(input.triangle_count());
    }
    // With swept boxes the objects are vertices and the faces that they are corners of, so all triangles would be near.
    if (skips(skip_near) && collider.among == Among::between_objects && input.objects.size() > 1 &&
        !input.is_swept() && builder_ != nullptr && !collider_->keeps_tree() &&
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

void Pipeline::begin_frame(std::span<const Motion> motions)
{
    const TreeUpdate asked =
        collider_->keeps_tree() ? collider_->next_frame() : TreeUpdate::rebuild;
    if (builder_ == nullptr)
        return;
    if (collider_->keeps_tree()) {
        updates_ = builder_->plan_update(std::vector(updates_.size(), asked), session_.queue());
    } else if (entering_) {
        const bool keeps_all =
            skips(skip_unchanged) && queries() && !motions.empty() &&
            std::ranges::count(motions, Motion::unchanged) == std::ssize(motions);
        updates_.assign(updates_.size(), keeps_all ? TreeUpdate::keep : TreeUpdate::rebuild);
    } else {
        updates_ = planned_updates(motions);
    }
}

std::vector<TreeUpdate> Pipeline::planned_updates(std::span<const Motion> motions)
{
    std::vector<TreeUpdate> wanted(updates_.size(), TreeUpdate::rebuild);
    for (std::size_t k = 0; k < motions.size(); ++k)
        if (skips(skip_unchanged) && motions[k] == Motion::unchanged)
            wanted[k] = TreeUpdate::keep;
        else if (skips(skip_rigid) && motions[k] <= Motion::rigid && builder_->can_refit())
            wanted[k] = TreeUpdate::refit;
    return builder_->plan_update(wanted, session_.queue());
}

/// Decides whether the rule `near` applies to this frame. Memory is reserved for the triangles that enter, and counting them
/// takes work of the device. That happens here, outside the timing; a simulation would use the count of the previous frame.
void Pipeline::choose_entering(const Input& input)
{
    if (!near_ || std::count(updates_.begin(), updates_.end(), TreeUpdate::rebuild) == 0)
        return;
    Queue& queue = session_.queue();
    std::vector<uint> counts = near_->find(input, queue);
    queue.finish();
    const std::size_t total = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
    if (total > NearTriangles::most_of(input.triangle_count())) {
        if (entering_) {
            entering_.reset();
            reserve_for(input);
            updates_ = planned_updates({});
        }
        return;
    }
    updates_.assign(updates_.size(), TreeUpdate::rebuild);
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
        if (updates_.front() != TreeUpdate::keep && near_->find(input, queue) != entering_->counts)
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
    if (builder_ != nullptr &&
        std::count(updates_.begin(), updates_.end(), TreeUpdate::keep) < std::ssize(updates_))
        tree_ = entering_ ? &builder_->build(input, queue) : &builder_->update(input, queue);
    collider_->query(tree_, input, queue);
}

bool Pipeline::complete()
{
    const Queue& queue = session_.queue();
    return !queries() || (collider_->complete(queue) && (!narrow_ || narrow_->complete(queue)));
}

std::vector<StageTime> Pipeline::settle(const Input& input)
{
    choose_entering(input);
    std::vector<StageTime> stages;
    do {
        enqueue(input);
        stages = session_.queue().finish();
    } while (!complete());
    corner_bytes_ =
        narrow_ && queries() ? corner_bytes(collider_->pairs(session_.queue()), input) : 0;
    return stages;
}

/// Adds the bytes of pairs and contacts to the stages. Their number is known only after the frame.
void Pipeline::declare_found(std::vector<StageTime>& stages) const
{
    if (!queries())
        return;
    const Queue& queue = session_.queue();
    const auto bytes = [](std::uint64_t pairs) {
        return static_cast<std::int64_t>(pairs * sizeof(Pair));
    };
    const std::int64_t pairs = bytes(collider_->counts(queue).pairs);
    add_moved_bytes(stages, "broad", pairs);
    if (narrow_)
        add_moved_bytes(stages, "narrow",
                        pairs + bytes(narrow_->counts(queue).contacts) + corner_bytes_);
}

std::vector<StageTime> Pipeline::once(const Input& input)
{
    session_.give_head_start();
    enqueue(input);
    std::vector<StageTime> stages = session_.queue().finish();
    if (!complete())
        throw Unavailable("a query found more than the one before it over the same triangles");
    declare_found(stages);
    return stages;
}

std::vector<Pair> Pipeline::pairs() const
{
    return queries() ? collider_->pairs(session_.queue()) : std::vector<Pair>();
}

std::vector<Pair> Pipeline::contacts() const
{
    return narrow_ && queries() ? narrow_->contacts(session_.queue()) : pairs();
}

std::map<std::string, double> Pipeline::transfers(const Input& input) const
{
    if (collider_->is_on_host() && !narrow_)
        return {};
    const auto median_ns = [](const std::function<void()>& copy) {
        copy();  // the first one may touch new memory
        std::vector<std::int64_t> times;
        std::int64_t all = 0;
        for (int k = 0; k < 5 && all < most_copying_ns; ++k)
            all += times.emplace_back(host_ns(copy));
        std::ranges::sort(times);
        return static_cast<double>(times[times.size() / 2]);
    };
    const cl::CommandQueue& queue = session_.queue().cl();
    Buffer<Point> points = input.device_points, end_points = input.device_end_points;
    std::map<std::string, double> times = {{"upload_ns", median_ns([&] {
                                                points.upload(queue, input.points);
                                                end_points.upload(queue, input.end_points);
                                            })}};
    const auto answer = counters().at(has_contacts() ? "contacts_count" : "pairs_count");
    if (answer * sizeof(Pair) < static_cast<double>(host_memory_left()))
        times["read_back_ns"] = median_ns([&] { has_contacts() ? contacts() : pairs(); });
    return times;
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
    if (entering_ && updates_.front() != TreeUpdate::keep)
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
    const auto updated = [&](TreeUpdate how) {
        const auto objects = static_cast<std::size_t>(std::ranges::count(updates_, how));
        const bool has_some = objects > 0 && queries();
        return !entering_ ? objects : has_some ? entering_->input.objects.size() : 0;
    };
    std::size_t memory = collider_->reserved().total();
    put("query_bytes", memory);
    if (builder_ != nullptr) {
        const Footprint tree = builder_->reserved();
        put("tree_bytes", tree.tree_bytes);
        put("scratch_bytes", tree.scratch_bytes);
        put("rebuilt_objects_count", updated(TreeUpdate::rebuild));
        put("refitted_objects_count", updated(TreeUpdate::refit));
        put("kept_objects_count", updated(TreeUpdate::keep));
        put("sorts_count", updated(TreeUpdate::rebuild) > 0 ? 1 : 0);
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
