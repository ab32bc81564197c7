// SPDX-License-Identifier: MIT
#include "harness/tune/trials.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "builders/stages/bounds.h"
#include "builders/stages/sort/sort.h"
#include "collide/oracles/exact_reference.h"
#include "collide/oracles/sweep.h"
#include "collide/parameters.h"
#include "geometry/error.h"
#include "geometry/hash.h"
#include "harness/choice/collider_catalog.h"
#include "harness/judge/check.h"
#include "harness/measure/pipeline.h"
#include "scenes/face_order.h"

namespace bvhbench {
namespace {

template <class Entry>
bool is_in(std::span<const Entry> catalog, const std::string& name)
{
    return std::any_of(catalog.begin(), catalog.end(),
                       [&](const Entry& entry) { return entry.name == name; });
}

Device tuned(Device device, const Tuning& tuning)
{
    device.tuning = tuning;
    return device;
}

/// A session of its own: what is compiled for other values must not be found by name.
class OwnSession : public Trial {
public:
    OwnSession(Session& session, const Tuning& tuning)
        : session_(tuned(session.device(), tuning), session.scenes())
    {}
    std::set<const Parameter*> asked() const override { return session_.device().tuning.asked(); }

protected:
    Session session_;
};

class SortTrial final : public OwnSession {
public:
    SortTrial(Session& session, const Tuning& tuning, const Input& input, const std::string& order)
        : OwnSession(session, tuning)
        , input_(input)
        , order_(find_order(order))
        , bounds_(session_.programs())
        , codes_(session_.programs(), order_)
        , sort_(session_.programs(), order_.code_bits, sort_shape(session_.device()))
    {
        Arena measuring = Arena::measuring(session_.device());
        plan(measuring);
        arena_ = Arena::reserved(session_.device(), measuring.used());
        plan(*arena_);
        bounds_.prepare(session_.queue().cl());
        sort_.prepare(session_.queue().cl());
        bounds_.enqueue(input_, session_.queue());
    }

    std::string wrong() override
    {
        codes_.enqueue(bounds_.boxes(), bounds_.bounds(), input_.device_owners,
                       sort_.unsorted_codes(), session_.queue());
        const std::vector<uint> unsorted = sort_.unsorted_codes().download(session_.queue().cl());
        once();
        return sort_.ids().download(session_.queue().cl()) == sorted(unsorted)
                   ? std::string()
                   : "ids are not those of a stable sort";
    }

    std::vector<StageTime> once() override
    {
        session_.give_head_start();
        codes_.enqueue(bounds_.boxes(), bounds_.bounds(), input_.device_owners,
                       sort_.unsorted_codes(), session_.queue());
        sort_.enqueue(session_.queue());
        std::vector<StageTime> stages = session_.queue().finish();
        std::erase_if(stages, [](const StageTime& time) { return time.stage != "sort"; });
        return stages;
    }

private:
    void plan(Arena& arena)
    {
        bounds_.plan(arena, input_.triangle_count(), Use::scratch);
        sort_.plan(arena, input_.triangle_count());
    }

    /// Ids in ascending order of codes, equal ones as they are: slow and obvious.
    std::vector<uint> sorted(const std::vector<uint>& codes) const
    {
        const std::size_t words = code_words(order_.code_bits);
        const auto code = [&](uint k) {
            return words == 1 ? codes[k] : std::uint64_t{codes[2 * k + 1]} << 32 | codes[2 * k];
        };
        std::vector<uint> ids(input_.triangle_count());
        std::iota(ids.begin(), ids.end(), 0u);
        std::stable_sort(ids.begin(), ids.end(), [&](uint a, uint b) { return code(a) < code(b); });
        return ids;
    }

    const Input& input_;
    const OrderEntry& order_;
    BoundsStage bounds_;
    CodesStage codes_;
    RadixSort sort_;
    std::optional<Arena> arena_;
};

class BuildTrial final : public OwnSession {
public:
    BuildTrial(Session& session, const Tuning& tuning, const BuilderChoice& choice,
               const Input& input, Oracle& oracle)
        : OwnSession(session, tuning)
        , choice_(choice)
        , input_(input)
        , oracle_(oracle)
        , builder_(make_builder(choice_, session_.programs()))
    {
        builder_->reserve(input.triangle_count());
    }

    std::string wrong() override
    {
        once();
        const Check check = check_ ? check_again(*tree_, *check_)
                                   : check_tree(tree_->spelled_out(), input_, choice_, oracle_);
        check_ = check;
        return check.verdict == Check::Verdict::differs ? check.detail : std::string();
    }

    std::vector<StageTime> once() override
    {
        return session_.build_once(*builder_, input_, Start::from_triangles, &tree_);
    }

private:
    BuilderChoice choice_;
    const Input& input_;
    Oracle& oracle_;
    std::unique_ptr<Builder> builder_;
    const Tree* tree_ = nullptr;
    std::optional<Check> check_;
};

/// What a query must find.
struct Answer {
    PairList pairs;
    std::optional<PairList> contacts;
};

class CollideTrial final : public OwnSession {
public:
    CollideTrial(Session& session, const Tuning& tuning, const TuneTask& task, const Input& input,
                 const Answer& answer)
        : OwnSession(session, tuning)
        , input_(input)
        , answer_(answer)
        , pipeline_(session_, task.builder, task.collider, input)
    {
        pipeline_.begin_frame({});
        pipeline_.settle(input_);
        if (pipeline_.collider().keeps_tree()) {  // what it goes on from, not where it begins
            pipeline_.begin_frame({});
            pipeline_.settle(input_);
        }
    }

    std::string wrong() override
    {
        once();
        std::string why;
        if (pipeline_.has_pairs())
            why = difference(pipeline_.pairs(), answer_.pairs, "pairs");
        if (why.empty() && pipeline_.has_contacts() && answer_.contacts)
            why = difference(pipeline_.contacts(), *answer_.contacts, "contacts");
        return why;
    }

    std::vector<StageTime> once() override { return pipeline_.once(input_); }

private:
    static std::string difference(const PairList& found, const PairList& expected,
                                  const std::string& what)
    {
        if (found.surplus() == 0 && found.size() == expected.size() &&
            found.hash() == expected.hash())
            return {};
        return std::to_string(found.size()) + ' ' + what + " of the hash " + hex(found.hash()) +
               ", and the reference has " + std::to_string(expected.size()) + " of " +
               hex(expected.hash());
    }

    const Input& input_;
    const Answer& answer_;
    Pipeline pipeline_;
};

}  // namespace

void check_target(const std::string& target)
{
    if (target == "sort" || is_in(builder_catalog(), target) || is_in(collider_catalog(), target))
        return;
    std::string known = "sort";
    for (const BuilderEntry& entry : builder_catalog())
        known += ", " + std::string(entry.name);
    for (const ColliderEntry& entry : collider_catalog())
        known += ", " + std::string(entry.name);
    throw BadUsage("nothing that could be tuned is called '" + target + "'; there are: " + known);
}

struct TuneTarget::Over {
    Scene scene;
    Input input;
    std::optional<Oracle> oracle;
    Answer answer;
};

TuneTarget::TuneTarget(Session& session, TuneTask task)
    : session_(session), task_(std::move(task)), over_(std::make_unique<Over>())
{
    check_target(task_.target);
    over_->scene = in_file_order(load_scene(task_.scene, session.scenes()));
    over_->input =
        upload(session.device(), session.queue(), over_->scene.frames.front(), over_->scene.faces);
    over_->oracle.emplace(session, over_->input);
    if (is_in(builder_catalog(), task_.target))
        task_.builder.name = task_.target;
    if (!is_in(collider_catalog(), task_.target))
        return;
    task_.collider.name = task_.target;
    const Input& input = over_->input;
    over_->answer.pairs = touching_pairs(input.points, input.faces, task_.collider.keep_adjacent);
    if (has_exact_reference && task_.collider.narrow != "none")
        over_->answer.contacts = intersecting_pairs(input.points, input.faces, over_->answer.pairs,
                                                    task_.collider.keep_adjacent);
}

TuneTarget::~TuneTarget() = default;

std::unique_ptr<Trial> TuneTarget::trial(const Tuning& tuning)
{
    if (task_.target == "sort")
        return std::make_unique<SortTrial>(session_, tuning, over_->input, task_.builder.order);
    if (task_.collider.name.empty())
        return std::make_unique<BuildTrial>(session_, tuning, task_.builder, over_->input,
                                            *over_->oracle);
    return std::make_unique<CollideTrial>(session_, tuning, task_, over_->input, over_->answer);
}

bool TuneTarget::wants(const Parameter& parameter) const
{
    if (task_.target == "sort")
        return parameter.stage == "sort";
    const bool is_colliders =
        std::find(std::begin(collider_parameters), std::end(collider_parameters), &parameter) !=
        std::end(collider_parameters);
    return task_.collider.name.empty() || is_colliders;
}

}  // namespace bvhbench
