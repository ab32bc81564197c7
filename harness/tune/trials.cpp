// SPDX-License-Identifier: MIT
#include "harness/tune/trials.h"

#include <algorithm>

#include "builders/parameters.h"
#include "collide/oracles/box_pairs.h"
#include "collide/oracles/exact_reference.h"
#include "collide/parameters.h"
#include "geometry/names.h"
#include "harness/judge/pair_counts.h"
#include "harness/measure/pipeline.h"
#include "scenes/face_order.h"

namespace bvhbench {
namespace {

constexpr std::string_view sort_stage = "sort";

/// Returns the frame over which a collider is timed: the second or, in a scene of one frame, that frame once more.
std::size_t timed_frame(const Scene& scene) { return scene.frames.size() > 1 ? 1 : 0; }

Device tuned(Device device, const Tuning& tuning)
{
    device.tuning = tuning;
    return device;
}

/// A trial with its own session, so that kernels compiled for other values are not reused by name.
class OwnSession : public Trial {
public:
    OwnSession(Session& session, const Tuning& tuning)
        : session_(tuned(session.device(), tuning), session.scenes())
    {}
    std::set<const Parameter*> asked() const override { return session_.device().tuning.asked(); }

protected:
    Session session_;
};

class BuildTrial final : public OwnSession {
public:
    /// If `stage` is named, only that stage's times are returned.
    BuildTrial(Session& session, const Tuning& tuning, const BuilderChoice& choice,
               const Input& input, Oracle& oracle, std::string_view stage)
        : OwnSession(session, tuning)
        , choice_(choice)
        , input_(input)
        , oracle_(oracle)
        , stage_(stage)
        , builder_(session_.builder(choice_))
    {
        builder_.reserve(input.triangle_count());
    }

    std::string wrong() override
    {
        once();
        check_ = check_ ? check_again(*tree_, input_, *check_)
                        : check_tree(tree_->to_host_tree(), input_, choice_, oracle_);
        return check_->verdict == Check::Verdict::differs ? check_->detail : std::string();
    }

    std::vector<StageTime> once() override
    {
        std::vector<StageTime> stages = session_.timed(
            [&] { return session_.build_once(builder_, input_, Start::from_triangles, &tree_); });
        std::erase_if(
            stages, [&](const StageTime& time) { return !stage_.empty() && time.stage != stage_; });
        return stages;
    }

private:
    BuilderChoice choice_;
    const Input& input_;
    Oracle& oracle_;
    std::string_view stage_;
    Builder& builder_;
    const Tree* tree_ = nullptr;
    std::optional<Check> check_;
};

class CollideTrial final : public OwnSession {
public:
    CollideTrial(Session& session, const Tuning& tuning, const TuneTask& task, const Scene& scene,
                 Input& input, const PairList& pairs, const std::optional<PairList>& contacts)
        : OwnSession(session, tuning)
        , input_(input)
        , pairs_(pairs)
        , contacts_(contacts)
        , pipeline_(session_, task.builder, task.collider, input)
    {
        // Timed in the second frame, which a collider that keeps its tree starts from what the first left.
        for (const std::size_t frame : {std::size_t{0}, timed_frame(scene)}) {
            input.points = scene.frames[frame];
            input.device_points.upload(session_.queue().cl(), input.points);
            pipeline_.begin_frame({});
            pipeline_.prepare(input_);
        }
    }

    std::string wrong() override
    {
        once();
        Differences pairs, contacts;
        if (pipeline_.has_pairs())
            pairs = differences(PairList(pipeline_.pairs()), pairs_);
        if (pipeline_.has_contacts() && contacts_)
            contacts = differences(PairList(pipeline_.contacts()), *contacts_);
        return pairs != Differences{}      ? pairs.text()
               : contacts != Differences{} ? "of contacts, " + contacts.text()
                                           : "";
    }

    std::vector<StageTime> once() override
    {
        return session_.timed([&] { return pipeline_.once(input_); });
    }

private:
    const Input& input_;
    const PairList& pairs_;
    const std::optional<PairList>& contacts_;
    Pipeline pipeline_;
};

}  // namespace

void check_target(const std::string& target)
{
    std::vector<std::string_view> known = {sort_stage};
    std::ranges::copy(names_of(builder_catalog()), std::back_inserter(known));
    std::ranges::copy(names_of(collider_catalog()), std::back_inserter(known));
    if (std::ranges::count(known, target) == 0)
        throw BadUsage("nothing that could be tuned is called '" + target + '\'' +
                       there_are(target, known));
}

TuneTarget::TuneTarget(Session& session, TuneTask task) : session_(session), task_(std::move(task))
{
    check_target(task_.target);
    scene_ = in_file_order(load_scene(task_.scene, session.scenes()));
    input_ = upload(session.device(), session.queue(), scene_.frames.front(), scene_.faces);
    if (find_name(builder_catalog(), task_.target))
        task_.builder.name = task_.target;
    if (!find_name(collider_catalog(), task_.target))
        return;
    task_.collider.name = task_.target;
    const bool keep_adjacent = task_.collider.keep_adjacent;
    const std::vector<Point>& points = scene_.frames[timed_frame(scene_)];
    pairs_ = touching_pairs(points, input_.faces, keep_adjacent);
    if (has_exact_reference && task_.collider.narrow != "none")
        contacts_ = intersecting_pairs(points, input_.faces, pairs_.pairs(), keep_adjacent);
}

std::unique_ptr<Trial> TuneTarget::trial(const Tuning& tuning)
{
    const bool of_sort = task_.target == sort_stage;
    Tuning own = tuning;
    if (of_sort && own.value(sort_at_once, session_.device().is_cpu()) == sort_at_once_with_boxes)
        own.set(sort_at_once, 1);  // the sort is a stage of its own
    if (task_.collider.name.empty())
        return std::make_unique<BuildTrial>(session_, own, task_.builder, input_, oracle_,
                                            of_sort ? sort_stage : "");
    return std::make_unique<CollideTrial>(session_, tuning, task_, scene_, input_, pairs_,
                                          contacts_);
}

bool TuneTarget::wants(const Parameter& parameter) const
{
    if (task_.target == sort_stage)
        return parameter.stage == sort_stage;
    return task_.collider.name.empty() || std::ranges::count(collider_parameters, &parameter) > 0;
}

}  // namespace bvhbench
