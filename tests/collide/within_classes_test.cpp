// SPDX-License-Identifier: MIT
//
// Pairs of all classes are within a distance if CGAL says so, at distances where a rounding would tell. With BVHBENCH_TESTS=all a million.
#include <bit>

#include "collide/within/closest.h"
#include "collide/within/within.h"
#include "geometry/cores.h"
#include "tests/collide/narrow_testing.h"

namespace bvhbench {
namespace {

/// Returns pairs of a class, or with `features` a vertex and a face, and two edges, of their triangles by turns: at night a million of all
/// classes.
Mesh pairs_of(const PairClass& of, uint seed, bool features)
{
    const auto classes = static_cast<uint>(pair_classes().size());
    Mesh mesh = apart_pairs(of, takes_all_cases() ? 1000000 / classes + 1 : 64, seed);
    for (std::size_t k = 0; features && k < mesh.faces.size(); k += 2) {
        Face &a = mesh.faces[k], &b = mesh.faces[k + 1];
        const bool of_edges = k % 4 == 2;
        a = {a.a, of_edges ? a.b : a.a, of_edges ? a.b : a.a};
        b.c = of_edges ? b.b : b.c;
    }
    return mesh;
}

bool is_within(const Mesh& mesh, Pair pair, double distance)
{
    return pairs_within(mesh.points, mesh.faces, {&pair, 1}, false, distance).size() == 1;
}

/// Returns the least double that is no less than the distance of a pair, by bisection with the oracle.
double least_distance(const Mesh& mesh, Pair pair)
{
    std::uint64_t low = 0, high = std::bit_cast<std::uint64_t>(1e40);
    while (low < high) {
        const std::uint64_t middle = low + (high - low) / 2;
        const bool is_enough = is_within(mesh, pair, std::bit_cast<double>(middle));
        (is_enough ? high : low) = middle + (is_enough ? 0 : 1);
    }
    return std::bit_cast<double>(low);
}

PairList found(const Candidates& candidates, const WithinOptions& options)
{
    WithinPhase phase(bench().programs, options);
    phase.reserve(candidates.input.device_points.size(), candidates.input.triangle_count());
    do
        phase.query(candidates.input, {candidates.on_device, candidates.counters}, bench().queue);
    while (!phase.complete(bench().queue));
    bench().queue.finish();
    return PairList(phase.pairs(bench().queue));
}

/// Expects the oracle's pairs of the kernel in both forms and of the host alone, and them among those of shapes around triangles.
void expect_right(const Candidates& candidates, double distance)
{
    const Mesh& mesh = candidates.mesh;
    const PairList wanted =
        pairs_within(mesh.points, mesh.faces, candidates.pairs.pairs(), false, distance);
    for (const WithinOptions& options :
         {WithinOptions{.distance = distance, .form = KernelForm::groups},
          WithinOptions{.distance = distance, .form = KernelForm::chunks},
          WithinOptions{.distance = distance, .without_doubles = true}}) {
        SCOPED_TRACE(testing::Message()
                     << distance << (options.without_doubles ? " on the host" : ""));
        expect_equal(mesh, found(candidates, options), wanted);
    }
    for (const NarrowMethod& method : narrow_methods(NarrowOf::distance))
        if (method.misses_none()) {
            const PairList near = found(candidates, {.distance = distance, .method = method.name});
            EXPECT_TRUE(std::ranges::includes(near.pairs(), wanted.pairs()))
                << method.name << " at " << distance;
        }
}

class WithinClasses : public OfAClass {};

TEST_P(WithinClasses, AreThoseOfTheOracle)
{
    for (const bool features : {false, true}) {
        const Mesh mesh = pairs_of(GetParam(), 21, features);
        const std::vector<Pair> pairs = neighbours(mesh);
        const Candidates candidates(mesh, pairs);
        for (const double distance : {0.0, 5e-324, 1e-30, 1e39})
            expect_right(candidates, distance);
        for (std::size_t k = 0; k < (takes_all_cases() ? 4 : 2); ++k) {
            const double least = least_distance(mesh, pairs[k]);
            for (const double distance :
                 {std::nextafter(least, 0.0), least, std::nextafter(least, 1e300)})
                expect_right(candidates, distance);
        }
    }
}

/// Each pair at its own distance, where the oracle's answer changes within a few doubles.
TEST_P(WithinClasses, AreToldAtTheirOwnDistance)
{
    for (const bool features : {false, true}) {
        const Mesh mesh = pairs_of(GetParam(), 22, features);
        const std::vector<Pair> pairs = neighbours(mesh);
        std::atomic<int> wrong = 0;
        on_all_cores(pairs.size(), [&](std::size_t k) {
            const double near = closest_points(corners_of(mesh.points, mesh.faces[pairs[k].a]),
                                               corners_of(mesh.points, mesh.faces[pairs[k].b]))
                                    .distance;
            for (const double distance :
                 {std::nextafter(near, 0.0), near, std::nextafter(near, 1e300)})
                wrong += are_within(mesh.points, mesh.faces, pairs[k], {.distance = distance}) !=
                                 is_within(mesh, pairs[k], distance)
                             ? 1
                             : 0;
        });
        EXPECT_EQ(wrong, 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Of, WithinClasses, all_classes, CaseName());

}  // namespace
}  // namespace bvhbench
