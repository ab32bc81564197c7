// SPDX-License-Identifier: MIT
#include "harness/collide.h"

#include <algorithm>
#include <future>
#include <memory>
#include <optional>

#include "collide/exact_reference.h"
#include "collide/narrow_methods.h"
#include "collide/sweep.h"
#include "geometry/error.h"
#include "geometry/hash.h"
#include "harness/accuracy/differences.h"
#include "harness/failure.h"
#include "harness/interrupt.h"
#include "harness/pipeline.h"
#include "harness/sampler.h"
#include "scenes/frames_between.h"

namespace bvhbench {
namespace {

/// What a frame's pairs and contacts are, found out when first asked for; pairs on another core.
class FrameOracle {
public:
    explicit FrameOracle(const Input& input) : input_(input) {}

    /// Begin with the pairs. Nothing may be timed before wait().
    void begin(const ColliderChoice& choice) { entry(choice); }

    /// Until all that was begun is there.
    void wait() const
    {
        for (const auto& one : entries_)
            one->pairs.wait();
    }

    const PairList& pairs(const ColliderChoice& choice) { return entry(choice).pairs.get(); }

    const PairList& contacts(const ColliderChoice& choice)
    {
        Entry& found = entry(choice);
        if (!found.contacts)
            found.contacts = intersecting_pairs(input_.points, input_.faces, found.pairs.get(),
                                                choice.keep_adjacent);
        return *found.contacts;
    }

private:
    struct Entry {
        Among among;
        bool keep_adjacent;
        std::shared_future<PairList> pairs;
        std::optional<PairList> contacts;
    };

    Entry& entry(const ColliderChoice& choice)
    {
        for (const auto& one : entries_)
            if (one->among == choice.among && one->keep_adjacent == choice.keep_adjacent)
                return *one;
        const auto found = [this, among = choice.among, keep_adjacent = choice.keep_adjacent] {
            return among_objects(touching_pairs(input_.points, input_.faces, keep_adjacent),
                                 input_.objects, among);
        };
        entries_.push_back(std::make_unique<Entry>(
            Entry{choice.among, choice.keep_adjacent, std::async(std::launch::async, found), {}}));
        return *entries_.back();
    }

    const Input& input_;
    std::vector<std::unique_ptr<Entry>> entries_;
};

/// Hold a list to the oracle's. What differs is added to the check.
void hold(const PairList& found, const PairList& expected, const std::string& what, Check& check)
{
    std::string detail;
    if (found.surplus() > 0)
        detail = std::to_string(found.surplus()) + ' ' + what + " were found twice";
    else if (found != expected)
        detail = "the oracle has " + std::to_string(expected.size()) + ' ' + what +
                 " of the hash " + hex(expected.hash());
    if (detail.empty())
        return;
    check.verdict = Check::Verdict::differs;
    check.detail += (check.detail.empty() ? "" : "; ") + detail;
}

/// Of contacts by a narrow phase that promises none to be right: how many are wrong.
void count_errors(const PairList& found, const PairList& expected, Cell& cell)
{
    const Differences wrong = differences(found, expected);
    cell.counters["missed_count"] = static_cast<double>(wrong.missed);
    cell.counters["false_count"] = static_cast<double>(wrong.false_ones);
    if (cell.check.verdict == Check::Verdict::agrees)
        cell.check.verdict = Check::Verdict::counted;
    cell.check.detail += std::to_string(wrong.missed) + " contacts missed, " +
                         std::to_string(wrong.false_ones) + " false";
}

/// The verdict on what a pipeline found.
void judge(const Pipeline& pipeline, Cell& cell, FrameOracle& oracle, Found& found)
{
    const ColliderChoice& choice = cell.collider;
    Check& check = cell.check;
    check = {.verdict = Check::Verdict::agrees, .against = {}, .detail = {}};
    found = {};
    if (pipeline.has_pairs()) {
        found.pairs = pipeline.pairs();
        check.against = "brute";
        check.pairs_hash = found.pairs.hash();
        hold(found.pairs, oracle.pairs(choice), "pairs", check);
    }
    if (pipeline.has_contacts()) {
        found.contacts = pipeline.contacts();
        check.contacts_hash = found.contacts.hash();
        if (has_exact_reference) {
            check.against += check.against.empty() ? "CGAL" : ", CGAL";
            const bool by_collider = pipeline.collider().finds_contacts();
            if (by_collider || find_narrow_method(choice.narrow).is_exact)
                hold(found.contacts, oracle.contacts(choice), "contacts", check);
            else
                count_errors(found.contacts, oracle.contacts(choice), cell);
        } else if (check.verdict == Check::Verdict::agrees) {
            check.verdict = Check::Verdict::not_checked;
            check.detail = "contacts: built without CGAL";
        }
    }
}

/// A pipeline and its cell of the frame at hand.
struct Running {
    Cell cell;
    std::unique_ptr<Pipeline> pipeline;
    std::string failure;  ///< why there is none, or none any more
    std::string number;   ///< which of the run's cells it is
};

Scene loaded(const CollideTask& task, const SceneLibrary& library)
{
    const DataSet* set = task.may_stand_in ? find_data_set(task.scene) : nullptr;
    Scene scene =
        set != nullptr ? load_or_stand_in(*set, library) : load_scene(task.scene, library);
    if (task.objects != ObjectsBy::automatic)
        scene = with_objects(std::move(scene), task.objects);
    return task.between > 0 ? with_frames_between(scene, task.between) : scene;
}

FrameRange checked(const CollideTask& task, const Scene& scene)
{
    const std::size_t there = scene.frames.size();
    const FrameRange range{task.frames.first, task.frames.end == 0 ? there : task.frames.end};
    if (range.first >= range.end || range.end > there)
        throw BadUsage("scene '" + task.scene + "' has frames 0 to " + std::to_string(there - 1) +
                       ", not " + std::to_string(range.first) + " to before " +
                       std::to_string(range.end));
    return range;
}

SceneFacts facts_of(const CollideTask& task, const Scene& scene)
{
    return {.name = scene.stand_in_for.empty() ? task.scene : scene.name,
            .triangles = scene.triangle_count(),
            .vertices = static_cast<std::int64_t>(scene.frames.front().size()),
            .objects = static_cast<std::int64_t>(scene.objects.size()),
            .source = scene.source,
            .stand_in_for = scene.stand_in_for,
            .outlier = scene.outlier,
            .rounding = scene.rounding,
            .bend_of = scene.bend_of,
            .content_hash = scene.content_hash};
}

/// Pairs by the numbers that a file's triangles have in it, where objects have put them into another order.
PairList numbered_as_in_file(const PairList& pairs, const Scene& scene)
{
    if (scene.file_faces.empty())
        return pairs;
    std::vector<Pair> numbered;
    for (const Pair pair : pairs.pairs())
        numbered.push_back({scene.file_faces[pair.a], scene.file_faces[pair.b]});
    return PairList(std::move(numbered));
}

void fail(Running& running, Session& session, const std::string& why)
{
    session.renew_queue();
    running.failure = why;
    running.cell.status = Cell::Status::failed;
    running.cell.reason = why;
    running.cell.samples.clear();
}

/// What is known before anything is made: the collider's own, and the oracle's sweep.
void require_memory(const Session& session, const ColliderChoice& choice, std::size_t triangles)
{
    if (const std::size_t bytes = find_collider(choice.name).host_bytes; bytes > 0)
        session.require_host_memory("collider " + choice.name, bytes * triangles);
    session.require_host_memory("checking the pairs", sweep_bytes(triangles));
}

/// What is known once they are counted: those found, and the oracle's.
void require_memory_for_pairs(const Session& session, const std::map<std::string, double>& counters)
{
    for (const char* counted : {"pairs_count", "contacts_count"})
        if (const auto count = counters.find(counted); count != counters.end())
            session.require_host_memory(
                "checking the pairs", 2 * sizeof(Pair) * static_cast<std::size_t>(count->second));
}

void sample(std::span<Running> all, const CollideTask& task, const Input& input, Session& session,
            int& order, FrameOracle& oracle, Found& found)
{
    std::vector<Timed> timed;
    std::vector<Running*> ready;
    for (Running& one : all) {
        if (!one.failure.empty() || one.cell.check.verdict == Check::Verdict::differs)
            continue;
        ready.push_back(&one);
        timed.push_back({one.cell.collider.name, [&] {
                             const Watchdog::Hand hand(session.watchdog(), one.number);
                             return session.watchdog().watch(
                                 [&] { return one.pipeline->once(input); });
                         }});
    }
    std::vector<Taken> taken = take_samples(timed, task.samples, task.warm_up, order);
    for (std::size_t k = 0; k < ready.size(); ++k) {
        Running& one = *ready[k];
        one.cell.samples = std::move(taken[k].samples);
        std::string failure = std::move(taken[k].failure);
        // What the last sample found: another pipeline may have used the same builder's tree since, so once more.
        if (failure.empty())
            failure = reason_of_failure([&] {
                one.pipeline->once(input);
                judge(*one.pipeline, one.cell, oracle, found);
            });
        if (!failure.empty())
            fail(one, session, failure);
    }
}

}  // namespace

FrameRange frame_range(const std::string& text)
{
    const std::size_t colon = std::min(text.find(':'), text.size());
    const auto number = [&](const std::string& digits) -> std::size_t {
        if (digits.empty() || digits.size() > 9 ||
            digits.find_first_not_of("0123456789") != digits.npos)
            throw BadUsage("frames are given as a:b, from a to before b, not as '" + text + "'");
        return std::stoul(digits);
    };
    const std::size_t first = number(text.substr(0, colon));
    if (colon == text.size())
        return {first, first + 1};
    const std::string end = text.substr(colon + 1);
    const FrameRange range{first, end.empty() ? 0 : number(end)};
    if (!end.empty() && range.end <= first)
        throw BadUsage("frames " + text + " are none");
    return range;
}

void collide_frames(Session& session, const CollideTask& task, int& order,
                    const std::function<void(std::vector<Cell>&&, const Found&)>& add,
                    const std::function<bool(std::size_t cells)>& passes)
{
    const Scene scene = loaded(task, session.scenes());
    const FrameRange frames = checked(task, scene);
    if (passes && passes((frames.end - frames.first) * task.pipelines.size()))
        return;
    std::vector<FaceRange> objects;
    for (const SceneObject& object : scene.objects)
        objects.push_back({object.first_face, object.face_count});

    Input input =
        upload(session.device(), session.queue(), scene.frames[frames.first], scene.faces, objects);
    std::vector<Running> all(task.pipelines.size());
    for (std::size_t frame = frames.first; frame < frames.end; ++frame) {
        throw_if_interrupted();
        input.points = scene.frames[frame];
        input.device_points.upload(session.queue().cl(), input.points);
        std::vector<Motion> motions;
        if (frame > frames.first)
            motions = object_motions(scene, frame - 1, frame);
        FrameOracle oracle(input);
        oracle.begin(
            task.pipelines.front().collider);  // while the first one is compiled and settles
        Found found;
        for (std::size_t k = 0; k < all.size(); ++k) {
            Running& one = all[k];
            one.cell = {};
            one.cell.experiment = task.experiment;
            one.cell.scene = facts_of(task, scene);
            one.cell.scene.frame = static_cast<std::int64_t>(frame);
            one.cell.builder = task.pipelines[k].builder;
            one.cell.collider = task.pipelines[k].collider;
            one.cell.operation = Operation::collide;
            one.cell.warm_up = task.warm_up;
            one.number = task.number + '/' + std::to_string(frame) + '/' + std::to_string(k);
            const Watchdog::Hand hand(session.watchdog(), one.number);
            if (one.failure.empty())
                one.failure = session.watchdog().given_up(one.number);
            if (one.failure.empty())
                one.failure = reason_of_failure([&] {
                    require_memory(session, one.cell.collider, input.triangle_count());
                    session.watchdog().watch([&] {
                        if (one.pipeline == nullptr)
                            one.pipeline = std::make_unique<Pipeline>(session, one.cell.builder,
                                                                      one.cell.collider, input);
                        if (!one.pipeline->collider().needs_tree())
                            one.cell.builder = {.name = "none"};
                        one.pipeline->begin_frame(motions);
                        one.pipeline->settle(input);
                    });
                    std::map<std::string, double> counters = one.pipeline->counters();
                    require_memory_for_pairs(session, counters);
                    one.cell.counters = std::move(counters);
                    judge(*one.pipeline, one.cell, oracle, found);
                });
            if (!one.failure.empty())
                fail(one, session, one.failure);
        }
        oracle.wait();  // if none has asked, too
        sample(all, task, input, session, order, oracle, found);
        std::vector<Cell> cells;
        for (Running& one : all)
            cells.push_back(std::move(one.cell));
        found = {numbered_as_in_file(found.pairs, scene),
                 numbered_as_in_file(found.contacts, scene)};
        add(std::move(cells), found);
    }
}

}  // namespace bvhbench
