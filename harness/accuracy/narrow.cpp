// SPDX-License-Identifier: MIT
//
// The axis narrow: narrow phases over classes of pairs of triangles, against CGAL's exact predicates.
#include <algorithm>

#include "collide/exact_reference.h"
#include "collide/host_collider.h"
#include "collide/narrow.h"
#include "geometry/error.h"
#include "geometry/hash.h"
#include "harness/accuracy/axes.h"
#include "harness/accuracy/axis.h"
#include "harness/accuracy/differences.h"
#include "harness/accuracy/narrow_truth.h"
#include "harness/failure.h"
#include "harness/interrupt.h"
#include "harness/query_bytes.h"
#include "harness/sampler.h"
#include "scenes/generate/pair_classes.h"

namespace bvhbench {
namespace {

/// Pairs at once: what bounds the memory of a class, be it as large as it may. About 250 MB on the host.
constexpr std::size_t most_at_once = 1u << 20;
constexpr int warm_up = 1;

/// A narrow phase and its cell of the class at hand.
struct Tried {
    Cell cell;
    std::unique_ptr<NarrowPhase> narrow;  ///< null if there cannot be one
    Differences wrong;
    NarrowCounts counts;
    std::uint64_t hash = 0;  ///< of the contacts of the piece at hand

    void fail(Session& session, const std::string& why)
    {
        session.renew_queue();
        narrow.reset();
        cell.status = Cell::Status::failed;
        cell.reason = why;
        cell.samples.clear();
    }
};

/// Some pairs of a class: on the host and on the device, with the right answer.
struct Piece {
    Mesh mesh;
    PairList meeting;
    Input input;
    DevicePairs candidates;
    std::vector<Pair> pairs;

    Piece(Session& session, const PairClass& of, uint count, uint seed)
        : mesh(apart_pairs(of, count, seed))
        , meeting(neighbours_that_meet(mesh))
        , input(upload(session.device(), session.queue(), mesh.points, mesh.faces))
        , candidates(room_for_pairs(session.device(), count))
        , pairs(pairs_of_neighbours(mesh))
    {
        copy_pairs(pairs, candidates, session.queue());
    }
};

PairList contacts_of(Tried& one, const Piece& piece, Session& session)
{
    find_contacts(*one.narrow, piece.input, piece.candidates.pairs, piece.candidates.counters,
                  session.queue());
    session.queue().finish();
    return PairList(one.narrow->contacts(session.queue()));
}

/// Samples of a piece are added to those of the pieces before it, one by one.
void add_samples(std::vector<Sample>& to, std::vector<Sample>&& more)
{
    if (to.empty()) {
        to = std::move(more);
        return;
    }
    for (std::size_t k = 0; k < std::min(to.size(), more.size()); ++k) {
        StageTime& sum = to[k].stages.front();
        const StageTime& time = more[k].stages.front();
        sum.busy_ns += time.busy_ns;
        sum.span_ns += time.span_ns;
        sum.wall_ns += time.wall_ns;
        sum.launches += time.launches;
        sum.moved_bytes += time.moved_bytes;
    }
}

/// Held to the right answer before and after it is timed: a race may strike only sometimes.
void judge(Tried& one, const Piece& piece, Session& session)
{
    const PairList found = contacts_of(one, piece, session);
    one.hash = found.hash();
    one.wrong += differences(found, piece.meeting);
    const NarrowCounts counts = one.narrow->counts(session.queue());
    one.counts.contacts += counts.contacts;
    one.counts.by_floats += counts.by_floats;
    one.counts.by_doubles += counts.by_doubles;
    one.counts.exactly += counts.exactly;
}

void judge_again(Tried& one, const Piece& piece, Session& session)
{
    const PairList found = contacts_of(one, piece, session);
    if (found.hash() == one.hash)
        return;
    one.cell.check.verdict = Check::Verdict::differs;
    one.cell.check.detail = "found other contacts the second time";
}

void measure_piece(const AxisRun& run, std::span<Tried> all, const Piece& piece)
{
    Session& session = run.session;
    std::vector<Tried*> ready;
    std::vector<Timed> timed;
    const std::int64_t corners = corner_bytes(piece.pairs, piece.input);
    for (Tried& one : all) {
        if (one.narrow == nullptr)
            continue;
        const std::string failure = reason_of_failure([&] {
            one.narrow->reserve(piece.mesh.faces.size());
            judge(one, piece, session);
        });
        if (!failure.empty()) {
            one.fail(session, failure);
            continue;
        }
        ready.push_back(&one);
        timed.push_back({one.cell.accuracy.method, [&, tried = &one] {
                             tried->narrow->query(piece.input, piece.candidates.pairs,
                                                  piece.candidates.counters, session.queue());
                             return session.queue().finish();
                         }});
    }
    std::vector<Taken> taken = take_samples(timed, run.task.samples, warm_up, run.order);
    for (std::size_t k = 0; k < ready.size(); ++k) {
        Tried& one = *ready[k];
        std::string failure = std::move(taken[k].failure);
        if (failure.empty())
            failure = reason_of_failure([&] {
                judge_again(one, piece, session);
                const auto moved = static_cast<std::int64_t>(
                    (piece.pairs.size() + one.narrow->counts(session.queue()).contacts) *
                    sizeof(Pair));
                for (Sample& sample : taken[k].samples)
                    add_moved_bytes(sample.stages, "narrow", corners + moved);
            });
        if (!failure.empty())
            one.fail(session, failure);
        else
            add_samples(one.cell.samples, std::move(taken[k].samples));
    }
}

void conclude(Tried& one, std::size_t pairs, std::size_t meeting)
{
    if (one.cell.status != Cell::Status::measured)
        return;
    auto& counters = one.cell.counters;
    const auto put = [&](const char* name, auto value) {
        counters[name] = static_cast<double>(value);
    };
    put("pairs_count", pairs);
    put("meeting_count", meeting);
    put("missed_count", one.wrong.missed);
    put("false_count", one.wrong.false_ones);
    put("narrow_float_count", one.counts.by_floats);
    put("narrow_double_count", one.counts.by_doubles);
    put("narrow_exact_count", one.counts.exactly);
    Check& check = one.cell.check;
    check.against = "CGAL";
    if (check.verdict == Check::Verdict::differs)
        return;
    const bool promises = find_narrow_method(one.cell.accuracy.method).is_exact;
    check.verdict = !promises                        ? Check::Verdict::counted
                    : one.wrong == Differences{}     ? Check::Verdict::agrees
                                                     : Check::Verdict::differs;
    if (check.verdict == Check::Verdict::differs)
        check.detail = std::to_string(one.wrong.missed) + " pairs missed, " +
                       std::to_string(one.wrong.false_ones) + " false";
}

void measure_class(const AxisRun& run, const PairClass& of, std::size_t pairs)
{
    std::vector<Tried> all;
    for (const NarrowMethod& method : narrow_methods()) {
        if (!run.task.wants(of.name, method.name))
            continue;
        Tried& one = all.emplace_back();
        one.cell = accuracy_cell("narrow", std::string(method.name), {});
        one.cell.accuracy.seed = run.task.seed;
        one.cell.warm_up = warm_up;
        const std::string failure = reason_of_failure([&] {
            one.narrow = std::make_unique<NarrowPhase>(run.session.programs(),
                                                       NarrowOptions{.method = method.name});
        });
        if (!failure.empty()) {
            one.cell.status = Cell::Status::skipped;
            one.cell.reason = failure;
        }
    }
    if (all.empty())
        return;
    Hash hash;
    std::size_t meeting = 0;
    std::string no_piece;
    uint seed = run.task.seed;
    for (std::size_t done = 0; done < pairs && no_piece.empty();) {
        throw_if_interrupted();
        const std::size_t count = std::min(most_at_once, pairs - done);
        no_piece = reason_of_failure([&] {
            run.session.require_host_memory("a class of pairs", 240 * count);
            const Piece piece(run.session, of, static_cast<uint>(count), seed++);
            hash.values(std::span<const Point>(piece.mesh.points));
            meeting += piece.meeting.size();
            measure_piece(run, all, piece);
        });
        done += count;
    }
    const auto many = static_cast<std::int64_t>(pairs);
    for (Tried& one : all) {
        SceneFacts& scene = one.cell.scene;
        scene.name = of.name;
        scene.triangles = 2 * many;
        scene.vertices = 6 * many;
        scene.objects = 1;
        scene.source = "pairs: " + of.summary;
        scene.content_hash = hash.get();
        if (!no_piece.empty())
            one.fail(run.session, no_piece);
        conclude(one, pairs, meeting);
        run.add(std::move(one.cell));
    }
}

}  // namespace

void measure_narrow(const AxisRun& run)
{
    if (!has_exact_reference)
        throw Unavailable("the axis narrow needs CGAL to count errors against; this program is built without it");
    std::vector<const PairClass*> wanted;
    for (const PairClass& of : pair_classes())
        for (const NarrowMethod& method : narrow_methods())
            if (run.task.wants(of.name, method.name) &&
                (wanted.empty() || wanted.back() != &of))
                wanted.push_back(&of);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        const std::size_t share = run.task.pairs * (k + 1) / wanted.size() - run.task.pairs * k / wanted.size();
        run.progress.note("accuracy, narrow: " + wanted[k]->name);
        measure_class(run, *wanted[k], std::max<std::size_t>(1, share));
    }
}

}  // namespace bvhbench
