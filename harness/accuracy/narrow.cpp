// SPDX-License-Identifier: MIT
//
// The axis narrow: narrow phases over classes of triangle pairs, against CGAL's exact predicates.
#include <algorithm>
#include <future>
#include <thread>

#include "collide/narrow/narrow.h"
#include "collide/oracles/exact_reference.h"
#include "collide/oracles/host_collider.h"
#include "geometry/error.h"
#include "geometry/hash.h"
#include "geometry/host_memory.h"
#include "harness/accuracy/axis.h"
#include "harness/base/failure.h"
#include "harness/judge/pair_counts.h"
#include "scenes/generate/pair_classes.h"

namespace bvhbench {
namespace {

/// Bytes of host memory per pair: six corners, two faces, and several copies of the pair.
constexpr std::size_t host_bytes_a_pair = 240;

/// A narrow phase and its results over the current class.
struct Phase {
    std::unique_ptr<NarrowPhase> narrow;  ///< null if it could not be made
    std::vector<Sample> samples;          ///< each sample is the sum over the pieces
    Differences wrong;
    NarrowCounts counts;
    std::uint64_t hash = 0;  ///< of the contacts of the current piece
};

/// Returns the pairs of a mesh made of pairs: triangles 0 and 1, 2 and 3, and so on.
std::vector<Pair> pairs_of_neighbours(const Mesh& mesh)
{
    std::vector<Pair> pairs;
    pairs.reserve(mesh.faces.size() / 2);
    for (uint k = 0; k + 1 < mesh.faces.size(); k += 2)
        pairs.push_back({k, k + 1});
    return pairs;
}

/// Returns the pairs that intersect by CGAL's exact predicates, computed on all host cores.
PairList pairs_that_meet(const Mesh& mesh, std::span<const Pair> pairs)
{
    const std::size_t workers = std::max(1u, std::thread::hardware_concurrency());
    const std::size_t share = pairs.size() / workers + 1;
    std::vector<std::future<PairList>> parts;
    for (std::size_t first = 0; first < pairs.size(); first += share)
        parts.push_back(std::async(std::launch::async, [&mesh, pairs, first, share] {
            const auto own = pairs.subspan(first, std::min(share, pairs.size() - first));
            return intersecting_pairs(mesh.points, mesh.faces, PairList({own.begin(), own.end()}),
                                      false);
        }));
    std::vector<Pair> meeting;
    for (auto& part : parts) {
        const PairList found = part.get();
        meeting.insert(meeting.end(), found.pairs().begin(), found.pairs().end());
    }
    return PairList(std::move(meeting));
}

/// A part of a class's pairs, on the host and on the device, with the correct answer.
struct Piece {
    Mesh mesh;
    std::vector<Pair> pairs;
    PairList meeting;
    Input input;
    DevicePairs candidates;

    Piece(Session& session, const PairClass& of, uint count, uint seed)
        : mesh(apart_pairs(of, count, seed))
        , pairs(pairs_of_neighbours(mesh))
        , meeting(pairs_that_meet(mesh, pairs))
        , input(upload(session.device(), session.queue(), mesh.points, mesh.faces))
        , candidates(room_for_pairs(session.device(), count))
    {
        copy_pairs(pairs, candidates, session.queue());
    }
};

std::vector<StageTime> query_once(NarrowPhase& narrow, const Piece& piece, Session& session)
{
    session.give_head_start();
    narrow.query(piece.input, piece.candidates.pairs, piece.candidates.counters, session.queue());
    return session.queue().finish();
}

PairList contacts_of(NarrowPhase& narrow, const Piece& piece, Session& session)
{
    do
        query_once(narrow, piece, session);
    while (!narrow.complete(session.queue()));
    return PairList(narrow.contacts(session.queue()));
}

void judge(Phase& phase, const Piece& piece, Session& session)
{
    const PairList found = contacts_of(*phase.narrow, piece, session);
    phase.hash = found.hash();
    phase.wrong += differences(found, piece.meeting);
    const NarrowCounts counts = phase.narrow->counts(session.queue());
    phase.counts.by_floats += counts.by_floats;
    phase.counts.by_doubles += counts.by_doubles;
    phase.counts.exactly += counts.exactly;
}

/// Adds the samples of a piece to those of the pieces before it, sample by sample.
void add_samples(std::vector<Sample>& to, std::vector<Sample>&& more, std::int64_t moved_bytes)
{
    for (Sample& sample : more)
        add_moved_bytes(sample.stages, "narrow", moved_bytes);
    if (to.empty()) {
        to = std::move(more);
        return;
    }
    for (std::size_t k = 0; k < std::min(to.size(), more.size()); ++k) {
        StageTime& sum = to[k].stages.front();
        const StageTime& time = more[k].stages.front();
        sum.busy_ns += time.busy_ns;
        sum.span_ns += time.span_ns;
        sum.launches += time.launches;
        sum.moved_bytes += time.moved_bytes;
    }
}

/// Checks each phase's answer before timing, and for equality with it after, because a race may strike in some runs only.
void measure_piece(Session& session, Engine& engine, std::span<Subject> cells,
                   std::span<Phase> phases, const Piece& piece)
{
    const std::int64_t corners = corner_bytes(piece.pairs, piece.input);
    for (std::size_t k = 0; k < cells.size(); ++k) {
        Subject& one = cells[k];
        Phase& phase = phases[k];
        if (one.cell.status != Cell::Status::measured)
            continue;
        engine.settle(one, [&] {
            phase.narrow->reserve(piece.mesh.faces.size());
            judge(phase, piece, session);
        });
        one.once = [&] { return query_once(*phase.narrow, piece, session); };
        one.judge_again = [&, corners] {
            const PairList found = contacts_of(*phase.narrow, piece, session);
            if (found.hash() != phase.hash)
                throw Unavailable("it found other contacts after the samples than before");
            const std::size_t pairs = piece.pairs.size() + found.size();
            add_samples(phase.samples, std::move(one.cell.samples),
                        corners + static_cast<std::int64_t>(pairs * sizeof(Pair)));
        };
    }
    engine.sample(cells);
}

void conclude(Cell& cell, Phase& phase, std::size_t pairs, std::size_t meeting)
{
    if (cell.status != Cell::Status::measured)
        return;
    cell.samples = std::move(phase.samples);
    const auto put = [&](const char* name, auto value) {
        cell.counters[name] = static_cast<double>(value);
    };
    put("pairs_count", pairs);
    put("meeting_count", meeting);
    put("missed_count", phase.wrong.missed);
    put("false_count", phase.wrong.false_ones);
    put("narrow_float_count", phase.counts.by_floats);
    put("narrow_double_count", phase.counts.by_doubles);
    put("narrow_exact_count", phase.counts.exactly);
    const bool promises = find_narrow_method(cell.accuracy.method).is_exact;
    cell.check.against = "CGAL";
    cell.check.verdict = !promises                      ? Check::Verdict::counted
                         : phase.wrong == Differences{} ? Check::Verdict::agrees
                                                        : Check::Verdict::differs;
    if (cell.check.verdict == Check::Verdict::differs)
        cell.check.detail = phase.wrong.text();
}

/// Returns the narrow phase. Throws BadUsage (skipped) without CGAL or doubles; other errors of the compiler mean failure.
std::unique_ptr<NarrowPhase> compiled(Session& session, const NarrowMethod& method)
{
    if (!has_exact_reference)
        throw BadUsage("built without CGAL, which errors are counted against");
    try {
        return std::make_unique<NarrowPhase>(session.programs(),
                                             NarrowOptions{.method = method.name});
    } catch (const Unavailable& error) {
        throw BadUsage(error.what());
    }
}

void measure_class(const AxisRun& run, const PairClass& of, std::size_t pairs)
{
    Engine engine = run.engine();
    std::vector<Subject> cells;
    std::vector<Phase> phases;
    for (const NarrowMethod& method : narrow_methods()) {
        if (!run.task.wants(of.name, method.name))
            continue;
        Subject& one = cells.emplace_back();
        one.cell = accuracy_cell("narrow", method.name, {});
        one.cell.accuracy.seed = run.task.seed;
        Phase& phase = phases.emplace_back();
        engine.settle(one, [&] { phase.narrow = compiled(run.session, method); });
    }
    Hash hash;
    std::size_t meeting = 0;
    uint seed = run.task.seed;
    const std::string no_piece = reason_of_failure([&] {
        for (std::size_t done = 0; has_exact_reference && done < pairs;
             done += run.task.pairs_at_once) {
            const std::size_t count = std::min(run.task.pairs_at_once, pairs - done);
            require_host_memory("a class of pairs", host_bytes_a_pair * count);
            const Piece piece(run.session, of, static_cast<uint>(count), seed++);
            hash.values(std::span<const Point>(piece.mesh.points));
            meeting += piece.meeting.size();
            measure_piece(run.session, engine, cells, phases, piece);
        }
    });
    const auto many = static_cast<std::int64_t>(pairs);
    for (std::size_t k = 0; k < cells.size(); ++k) {
        Cell& cell = cells[k].cell;
        cell.scene.name = of.name;
        cell.scene.triangles = 2 * many;
        cell.scene.vertices = 6 * many;
        cell.scene.objects = 1;
        cell.scene.source = "pairs: " + of.summary;
        cell.scene.content_hash = hash.get();
        if (!no_piece.empty())
            engine.refuse(cells[k], Cell::Status::failed, no_piece);
        conclude(cell, phases[k], pairs, meeting);
        run.add(std::move(cell));
    }
}

}  // namespace

void measure_narrow(const AxisRun& run)
{
    std::vector<const PairClass*> wanted;
    for (const PairClass& of : pair_classes())
        if (std::ranges::any_of(narrow_methods(), [&](const NarrowMethod& method) {
                return run.task.wants(of.name, method.name);
            }))
            wanted.push_back(&of);
    const std::size_t pairs = run.task.pairs;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        const std::size_t share = pairs * (k + 1) / wanted.size() - pairs * k / wanted.size();
        run.progress.note("accuracy, narrow: " + wanted[k]->name);
        measure_class(run, *wanted[k], std::max<std::size_t>(1, share));
    }
}

}  // namespace bvhbench
