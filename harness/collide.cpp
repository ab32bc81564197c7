// SPDX-License-Identifier: MIT
#include "harness/collide.h"

#include "collide/sweep.h"
#include "geometry/error.h"
#include "geometry/hash.h"
#include "harness/frames.h"
#include "harness/sampler.h"

namespace bvhbench {
namespace {

constexpr int warm_up = 3;

/// The verdict on what a query found.
Check check_pairs(const PairList& found, const PairList& expected)
{
    Check check;
    check.against = "brute";
    check.pairs_hash = found.hash();
    check.verdict = Check::Verdict::differs;
    if (found.surplus() > 0)
        check.detail = std::to_string(found.surplus()) + " pairs were found twice";
    else if (found != expected)
        check.detail = "the oracle has " + std::to_string(expected.size()) + " pairs of the hash " +
                       hex(expected.hash());
    else
        check.verdict = Check::Verdict::agrees;
    return check;
}

std::map<std::string, double> counters_of(const QueryCounts& counts, const Collider& collider)
{
    std::map<std::string, double> counters = {
        {"pairs_count", static_cast<double>(counts.pairs)},
        {"query_bytes", static_cast<double>(collider.reserved().total())}};
    if (counts.box_tests)
        counters["box_tests_count"] = static_cast<double>(*counts.box_tests);
    if (counts.bvtt_peak)
        counters["bvtt_peak_count"] = static_cast<double>(*counts.bvtt_peak);
    return counters;
}

}  // namespace

Cell collide_scene(Session& session, const CollideCommand& command, PairList& pairs)
{
    Experiment experiment;
    experiment.may_stand_in = false;  // who names a mesh means that mesh
    Frames frames;
    frames.load(experiment, command.scene, session.scenes());

    Cell cell;
    cell.experiment = "collide";
    cell.scene = frames.facts();
    cell.builder = command.builder;
    cell.collider = command.collider;
    cell.operation = Operation::collide;
    cell.warm_up = warm_up;
    frames.upload(session);
    const Input& input = frames.now();
    Queue& queue = session.queue();

    Builder& builder = session.builder(command.builder);
    builder.reserve(input.triangle_count());
    const Tree* tree = nullptr;
    session.build_once(builder, input, Start::from_triangles, &tree);

    const std::unique_ptr<Collider> collider =
        make_collider(command.collider.name, session.programs(), command.collider.options());
    collider->reserve(tree, input);
    find_pairs(*collider, tree, input, queue);
    const PairList expected =
        touching_pairs(input.points, input.faces, command.collider.keep_adjacent);
    const auto judge = [&] {
        pairs = PairList(collider->pairs(queue));
        cell.check = check_pairs(pairs, expected);
    };
    judge();
    cell.counters = counters_of(collider->counts(queue), *collider);
    queue.finish();
    if (cell.check.verdict == Check::Verdict::differs)
        return cell;

    int order = 0;
    const auto once = [&] {
        collider->query(&builder.build(input, queue), input, queue);
        std::vector<StageTime> stages = queue.finish();
        if (!collider->complete(queue))
            throw Unavailable("a query found more than the one before it over the same triangles");
        return stages;
    };
    std::vector<Taken> taken =
        take_samples(std::vector<Timed>{{std::string(command.collider.name), once}},
                     command.samples, warm_up, order);
    if (!taken.front().failure.empty())
        throw Unavailable(taken.front().failure);
    cell.samples = std::move(taken.front().samples);
    judge();
    return cell;
}

}  // namespace bvhbench
