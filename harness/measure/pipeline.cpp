// SPDX-License-Identifier: MIT
#include "harness/measure/pipeline.h"

#include <algorithm>
#include <utility>

#include "geometry/error.h"
#include "harness/judge/pair_counts.h"

namespace bvhbench {
namespace {

/// Returns the rules that a choice excludes. With `first` not all pairs and tests are known that `margin` and `deforming` go by; with a
/// distance boxes are padded, and rules that go by the points do not know.
unsigned rules_without(const ColliderChoice& choice)
{
    constexpr unsigned of_updates = skip_unchanged | skip_rigid | skip_deforming | skip_margin;
    if (choice.distance || choice.update == FrameUpdate::refit)
        return of_updates | skip_near;
    if (choice.update == FrameUpdate::rebuild)
        return of_updates;
    return choice.first ? skip_margin | skip_deforming : 0u;
}

/// Returns the longest side of the box around both frames of a swept input; nothing for another input.
std::optional<float> swept_size(const Input& input)
{
    if (!input.is_swept())
        return std::nullopt;
    Aabb box = empty_box();
    for (const auto& points : {input.points, input.end_points})
        for (const Point p : points)
            box = merged(box, triangle_box(p, p, p));
    return std::max({box.max_x - box.min_x, box.max_y - box.min_y, box.max_z - box.min_z});
}

/// Throws BadUsage if trees cannot be made as chosen.
void check_trees(const ColliderChoice& choice, const Collider& collider, const Builder* builder)
{
    const bool refits = choice.update == FrameUpdate::refit;
    if (builder == nullptr &&
        (choice.update != FrameUpdate::automatic || choice.trees == TreeOver::scene))
        throw BadUsage("'update' and 'trees' are about a builder's trees, and the collider " +
                       choice.name + " queries none");
    if (refits && collider.keeps_tree())
        throw BadUsage("the collider " + choice.name +
                       " refits its tree by itself: 'update' is auto or rebuild for it, not refit");
    if (refits && !builder->can_refit())
        throw BadUsage("the builder " + std::string(builder->card().name) +
                       " cannot refit a tree: 'update' is auto or rebuild for it, not refit");
}

}  // namespace

Pipeline::Pipeline(Session& session, const BuilderChoice& builder, const ColliderChoice& collider,
                   const Input& input)
    : session_(session)
    , choice_(builder)
    , update_(collider.update)
    , one_tree_(one_tree_for(session, collider, input))
    , uploaded_(session.device())
    , updates_(one_tree_ ? 1 : input.objects.size(), TreeUpdate::rebuild)
{
    const bool on_cpu = session.device().is_cpu() || !find_collider(collider.name).needs_tree;
    ColliderChoice used = one_tree_ ? one_tree_->question() : collider;
    rules_off_ = used.rules_off =
        skip_rules_off(collider.rules_off, collider.rules_forced, on_cpu, input.triangle_count()) |
        rules_without(collider);
    collider_ = make_collider(used, session.programs());
    const bool from_outside = find_collider(collider.name).outside != nullptr;
    if (input.is_swept() && collider_->finds_contacts() && !from_outside)
        throw BadUsage("swept boxes are of the way between two frames, and the collider " +
                       collider.name + " looks at one moment");
    if (collider_->needs_tree())
        builder_ = make_builder(choice_, session.programs());
    check_trees(collider, *collider_, builder_.get());
    const bool pads = collider.distance && (input.is_swept() || !from_outside);
    if (pads && (collider_->is_on_host() || collider_->finds_contacts() ||
                 (builder_ && builder_->card().runs != BuilderCard::Runs::on_device) ||
                 (builder_ && find_builder(choice_.name).outside != nullptr)))
        throw BadUsage((input.is_swept() ? "'separation'" : "'within'") +
                       std::string(" pads boxes on the device: a collider of the host and a "
                                   "builder of the host or from outside do without"));
    reserve_for(input);
    if (pads && input.is_swept()) {
        padding_.emplace(session.programs(), collider.form, true);
        padding_->reserve(input.device_points.size());
    }
    if (pads && !input.is_swept()) {
        within_.emplace(session.programs(), WithinOptions{.distance = *collider.distance,
                                                          .method = collider.narrow,
                                                          .keep_adjacent = collider.keep_adjacent,
                                                          .form = collider.form});
        within_->reserve(input.device_points.size(), input.triangle_count());
    } else if (collider.narrow != "none" && !collider_->finds_contacts()) {
        narrow_.emplace(session.programs(),
                        NarrowOptions{.method = collider.narrow,
                                      .keep_adjacent = collider.keep_adjacent,
                                      .form = collider.form,
                                      .swept_size = swept_size(input),
                                      .separation = padding_ ? *collider.distance : 0,
                                      .is_wide = input.is_wide()});
        narrow_->reserve(input.triangle_count());
    }
    // With swept boxes the objects are vertices and the faces that they are corners of, so all triangles would be near.
    if (skips(skip_near) && collider.among == Among::between_objects && input.objects.size() > 1 &&
        input.objects.size() <= NearTriangles::most_objects && !input.is_swept() &&
        builder_ != nullptr && !collider_->keeps_tree() && !one_tree_ &&
        collider.filter.is_empty()) {
        near_.emplace(session.programs(), NearOptions{});
        near_->reserve(input);
    }
    // A builder on the host reads the host's points, which have no room; one from outside may.
    if (skips(skip_margin) && skip_rule(skip_margin).applies_to(collider.name) &&
        !input.is_swept() && builder_->card().runs == BuilderCard::Runs::on_device &&
        find_builder(choice_.name).outside == nullptr) {
        margin_.emplace(session.programs(), collider.form);
        margin_->reserve(input);
        if (narrow_)
            standing_.emplace(session.programs(), collider.form);
    }
}

void Pipeline::reserve_for(const Input& input)
{
    if (builder_ != nullptr) {
        const Input& of_trees = one_tree_ ? one_tree_->built(input) : input;
        builder_->reserve_objects(object_sizes(of_trees));
        session_.build_once(*builder_, of_trees, Start::from_triangles, &tree_);
        take_tree(*tree_, of_trees);
        session_.queue().forget();
    }
    collider_->reserve(tree_, one_tree_ ? one_tree_->queried(input) : input);
}

/// Queries will be of `tree`, or of its copy on the device if it is on the host.
void Pipeline::take_tree(const Tree& tree, const Input& of_trees)
{
    tree_ = &tree;
    if (dynamic_cast<const DeviceTree*>(&tree) == nullptr)
        session_.queue().on_host(
            "to_device", [&] { tree_ = &uploaded_.copy(tree, of_trees, session_.queue()); });
}

void Pipeline::enqueue(const Input& input)
{
    Queue& queue = session_.queue();
    if (within_) {
        enqueue_query(within_->padded(input, queue));
        within_->query(input, collider_->device_pairs(queue), queue);
    } else if (padding_) {
        enqueue_query(padding_->padded(input, reach_, queue));
    } else if (!is_plain()) {
        enqueue_margin(input);
    } else if (!entering_) {
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
    if (narrow_)
        enqueue_narrow(input);
}

void Pipeline::enqueue_query(const Input& input)
{
    Queue& queue = session_.queue();
    const Input& of_trees = one_tree_ ? one_tree_->built(input) : input;
    if (builder_ != nullptr &&
        std::count(updates_.begin(), updates_.end(), TreeUpdate::keep) < std::ssize(updates_))
        take_tree(entering_ || !is_plain() ? builder_->build(of_trees, queue)
                                           : builder_->update(of_trees, queue),
                  of_trees);
    collider_->query(tree_, one_tree_ ? one_tree_->queried(input) : input, queue);
}

bool Pipeline::complete()
{
    const Queue& queue = session_.queue();
    if (!queries())
        return true;
    if (does_ != MarginFrame::served && !collider_->complete(queue))
        return false;
    if (does_ == MarginFrame::renewed &&
        std::exchange(listed_, collider_->counts(queue).pairs) != collider_->counts(queue).pairs)
        return false;  // the filter was launched over as many as an older list had
    return (is_plain() || margin_->complete(queue)) && (!narrow_ || narrow_->complete(queue)) &&
           (!within_ || within_->complete(queue));
}

std::vector<StageTime> Pipeline::prepare(const Input& input)
{
    begin_margin(input);
    if (is_plain())
        choose_entering(input);
    if (padding_ && narrow_)
        reach_ = reach_of(distance_of_floats(input, narrow_->separation()));
    std::vector<StageTime> stages;
    do {
        enqueue(input);
        stages = session_.queue().finish();
    } while (!complete());
    note_tests();
    has_all_contacts_ = narrow_ && queries();
    const std::vector<Pair> tested = has_all_contacts_ ? tested_pairs() : std::vector<Pair>();
    tested_ = tested.size();
    corner_bytes_ = corner_bytes(tested, input);
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
    add_moved_bytes(stages, "broad", bytes(pair_count()));
    if (!narrow_)
        return;
    const std::uint64_t contacts = narrow_->counts(queue).contacts;
    const auto times =
        static_cast<std::int64_t>(narrow_->is_swept() ? contacts * sizeof(float) : 0);
    add_moved_bytes(stages, "narrow", bytes(tested_) + bytes(contacts) + times + corner_bytes_);
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
    return queries() ? found_pairs() : std::vector<Pair>();
}

std::vector<Pair> Pipeline::contacts() const
{
    if (within_)
        return within_->pairs(session_.queue());
    return narrow_ && queries() ? narrow_->contacts(session_.queue()) : pairs();
}

std::vector<float> Pipeline::impact_times() const
{
    if (!narrow_ || !narrow_->is_swept())
        return {};
    const std::vector<Pair> pairs = contacts();
    const std::vector<float> times = narrow_->impact_times(session_.queue());
    std::vector<std::pair<Pair, float>> both;
    for (std::size_t k = 0; k < pairs.size(); ++k)
        both.emplace_back(pairs[k], times[k]);
    std::ranges::sort(both);
    std::vector<float> sorted;
    for (const auto& [pair, time] : both)
        sorted.push_back(time);
    return sorted;
}

}  // namespace bvhbench
