// SPDX-License-Identifier: MIT
//
// The axis narrow: narrow phases over classes of triangle pairs, against CGAL's exact predicates.
#include <algorithm>
#include <map>

#include "collide/narrow/narrow.h"
#include "collide/oracles/exact_reference.h"
#include "collide/oracles/host_collider.h"
#include "geometry/error.h"
#include "geometry/hash.h"
#include "geometry/host_memory.h"
#include "harness/accuracy/axis.h"
#include "harness/accuracy/error_sizes.h"
#include "harness/base/failure.h"
#include "harness/judge/pair_counts.h"
#include "plugins/state.h"
#include "scenes/generate/pair_classes.h"

namespace bvhbench {
namespace {

/// Bytes of host memory per pair: six corners, two faces, and several copies of the pair.
constexpr std::size_t host_bytes_a_pair = 240;

/// Pairs of a piece whose errors are sized, of each kind: the distance of triangles that nearly touch takes 0.1 ms, in integers.
constexpr std::size_t sized_pairs = 1000;

/// Returns the pairs of a mesh made of pairs: triangles 0 and 1, 2 and 3, and so on.
std::vector<Pair> pairs_of_neighbours(const Mesh& mesh)
{
    std::vector<Pair> pairs;
    pairs.reserve(mesh.faces.size() / 2);
    for (uint k = 0; k + 1 < mesh.faces.size(); k += 2)
        pairs.push_back({k, k + 1});
    return pairs;
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
        , meeting(intersecting_pairs(mesh.points, mesh.faces, pairs, false))
        , input(upload(session.device(), session.queue(), mesh.points, mesh.faces))
        , candidates(room_for_pairs(session.device(), count))
    {
        copy_pairs(pairs, candidates, session.queue());
    }
};

PairList contacts_of(NarrowPhase& narrow, const Piece& piece, Session& session)
{
    find_contacts(narrow, piece.input, piece.candidates.pairs, piece.candidates.counters,
                  session.queue());
    session.queue().finish();
    return PairList(narrow.contacts(session.queue()));
}

/// Returns the narrow phase. Throws BadUsage (skipped) without doubles; other errors of the compiler mean failure.
std::shared_ptr<NarrowPhase> compiled(Session& session, const NarrowMethod& method)
{
    try {
        return std::make_shared<NarrowPhase>(session.programs(),
                                             NarrowOptions{.method = method.name});
    } catch (const Unavailable& error) {
        throw BadUsage(error.what());
    }
}

void put(Cell& cell, const char* name, auto value)
{
    cell.counters[name] = static_cast<double>(value);
}

/// Writes what a method found in a piece to its cell.
void count_piece(const PairList& found, const Piece& piece, ErrorSizes& sizes, Cell& cell)
{
    sizes.add(found, piece.meeting, piece.mesh.points, piece.mesh.faces, 0, sized_pairs);
    count_errors(found, piece.meeting, cell);
    put(cell, "pairs_count", piece.pairs.size());
    put(cell, "meeting_count", piece.meeting.size());
}

/// Returns the names of our narrow phases, and of those from outside behind them.
std::vector<std::string> method_names()
{
    std::vector<std::string> names;
    for (const NarrowMethod& method : narrow_methods(NarrowOf::moment))
        names.emplace_back(method.name);
    for (const outside::Offer& offer : outside_offers())
        if (offer.method.narrows)
            names.push_back(offer.method.name);
    return names;
}

AxisMethod from_outside(Session& session, const outside::Offer& offer, const Piece& piece,
                        ErrorSizes& sizes)
{
    const auto prepare = [&](Measurement& one) {
        const auto state =
            std::make_shared<outside::State>(offer.library, offer.method, offer.limits);
        state->send_frame(piece.input);
        state->send_candidates(piece.pairs);
        one.once = [&, state] {
            state->run("narrow", session.queue());
            return session.queue().finish();
        };
        one.judge_again = [&, state] {
            count_piece(PairList(state->pairs()), piece, sizes, one.cell);
        };
    };
    return {.name = offer.method.name, .prepare = prepare};
}

/// Of each method, over all pieces of a class. Shares of each pair's own box: pairs of one class differ in size.
using SizesOfMethods = std::map<std::string, ErrorSizes>;

/// Adds a cell for each method. Looks at the contacts before and after timing, because a race may strike in some runs only.
void measure_piece(const AxisRun& run, const std::string& name, const Piece& piece,
                   SizesOfMethods& sizes)
{
    Session& session = run.session;
    std::vector<AxisMethod> methods;
    for (const NarrowMethod& method : narrow_methods(NarrowOf::moment)) {
        const auto prepare = [&](Measurement& one) {
            const std::shared_ptr<NarrowPhase> narrow = compiled(session, method);
            narrow->reserve(piece.mesh.faces.size());
            const PairList first = contacts_of(*narrow, piece, session);
            const std::uint64_t hash = first.hash();
            const auto listed = static_cast<std::int64_t>(piece.pairs.size() + first.size());
            const std::int64_t moved =
                corner_bytes(piece.pairs, piece.input) + listed * std::int64_t{sizeof(Pair)};
            one.once = [&, narrow, moved] {  // never complete(), so that the exact test is launched
                session.give_head_start();
                narrow->query(piece.input, piece.candidates.pairs, piece.candidates.counters,
                              session.queue());
                std::vector<StageTime> stages = session.queue().finish();
                add_moved_bytes(stages, "narrow", moved);
                return stages;
            };
            one.judge_again = [&, narrow, hash] {
                const PairList found = contacts_of(*narrow, piece, session);
                if (found.hash() != hash)
                    throw Unavailable("it found other contacts after the samples than before");
                count_piece(found, piece, sizes[std::string(method.name)], one.cell);
                const NarrowCounts counts = narrow->counts(session.queue());
                put(one.cell, "narrow_float_count", counts.by_floats);
                put(one.cell, "narrow_double_count", counts.by_doubles);
                put(one.cell, "narrow_exact_count", counts.exactly);
            };
        };
        methods.push_back({.name = std::string(method.name), .prepare = prepare});
    }
    for (const outside::Offer& offer : outside_offers())
        if (offer.method.narrows)
            methods.push_back(from_outside(session, offer, piece, sizes[offer.method.name]));
    measure_methods(run, "narrow", {.name = name}, methods);
}

/// Adds the counters of a piece's cell to those of the pieces before it, and the samples one by one. The first failure stays.
void add_piece(Cell& all, Cell&& piece)
{
    if (all.status != Cell::Status::measured)
        return;
    if (all.samples.empty() || piece.status != Cell::Status::measured) {
        all = std::move(piece);
        return;
    }
    for (const auto& [name, count] : piece.counters)
        all.counters[name] += count;
    for (std::size_t k = 0; k < std::min(all.samples.size(), piece.samples.size()); ++k) {
        StageTime& sum = all.samples[k].stages.front();
        const StageTime& time = piece.samples[k].stages.front();
        sum.busy_ns += time.busy_ns;
        sum.span_ns += time.span_ns;
        sum.wall_ns += time.wall_ns;
        all.samples[k].wall_ns += piece.samples[k].wall_ns;
        sum.launches += time.launches;
        sum.moved_bytes += time.moved_bytes;
    }
}

void measure_class(const AxisRun& run, const PairClass& of, std::size_t pairs)
{
    std::vector<Cell> cells;  // each the sum over the pieces
    for (const std::string& method : method_names())
        if (run.task.wants(of.name, method))
            cells.push_back(accuracy_cell("narrow", method, {}));
    std::size_t next = 0;
    const AxisRun of_pieces{run.session, run.task, run.order, run.progress, [&](Cell&& cell) {
                                add_piece(cells[next++ % cells.size()], std::move(cell));
                            }};
    SizesOfMethods sizes;
    Hash hash;
    uint seed = run.task.seed;
    bool cannot_be = false;
    const std::string failure = reason_of_failure(
        [&] {
            if (!has_exact_reference)
                throw BadUsage("built without CGAL, which errors are counted against");
            for (std::size_t done = 0; done < pairs; done += run.task.pairs_at_once) {
                const std::size_t count = std::min(run.task.pairs_at_once, pairs - done);
                require_host_memory("a class of pairs", host_bytes_a_pair * count);
                const Piece piece(run.session, of, static_cast<uint>(count), seed++);
                hash.values(std::span<const Point>(piece.mesh.points));
                measure_piece(of_pieces, of.name, piece, sizes);
            }
        },
        &cannot_be);
    const auto many = static_cast<std::int64_t>(pairs);
    for (Cell& cell : cells) {
        cell.scene.name = of.name;
        cell.scene.triangles = 2 * many;
        cell.scene.vertices = 6 * many;
        cell.scene.objects = 1;
        cell.scene.source = "pairs: " + of.summary;
        cell.scene.content_hash = hash.get();
        cell.accuracy.seed = run.task.seed;
        if (!failure.empty())
            run.engine().refuse(cell, cannot_be ? Cell::Status::skipped : Cell::Status::failed,
                                failure);
        else if (cell.status == Cell::Status::measured) {
            sizes[cell.accuracy.method].put(cell);
            if (outside_library(cell.accuracy.method) != nullptr)
                judge_errors(cell, "CGAL", false);
            else
                judge_contacts(cell, "CGAL", cell.accuracy.method);
        }
        run.add(std::move(cell));
    }
}

}  // namespace

void measure_narrow(const AxisRun& run)
{
    std::vector<const PairClass*> wanted;
    for (const PairClass& of : pair_classes())
        if (std::ranges::any_of(method_names(), [&](const std::string& method) {
                return run.task.wants(of.name, method);
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
