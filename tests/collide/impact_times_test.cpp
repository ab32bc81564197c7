// SPDX-License-Identifier: MIT
//
// When the oracle between two frames says that features touch first: by hand, and on random lattices, where degenerate motions are common,
// against algebraic numbers alone and against the oracle of one moment.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "collide/oracles/swept_reference.h"
#include "tests/needing.h"

namespace bvhbench {
namespace {

using Four = std::array<WidePoint, 4>;
constexpr std::optional<double> never;

struct ByHand {
    const char* name;
    MovingQuery query;
    std::optional<double> time;  ///< when they first touch, rounded to the nearest double
};

/// A vertex on its way past a face whose second corner moves to `last_corner`.
ByHand vertex(const char* name, WidePoint from, WidePoint to, std::optional<double> time,
              WidePoint last_corner = {1, 0, 0})
{
    const WidePoint a = {0, 0, 0}, b = {1, 0, 0}, c = {0, 1, 0};
    return {name, {{from, a, b, c}, {to, a, last_corner, c}, false}, time};
}

/// An edge on its way past the edge from -1 to 1 on the first axis, which rests.
ByHand edge(const char* name, std::array<WidePoint, 2> from, std::array<WidePoint, 2> to,
            std::optional<double> time)
{
    const WidePoint left = {-1, 0, 0}, right = {1, 0, 0};
    return {name, {{left, right, from[0], from[1]}, {left, right, to[0], to[1]}, true}, time};
}

constexpr WidePoint raised = {1, 0, 1};  // the face is then in the plane z = t x

const ByHand by_hand[] = {
    vertex("a third", {.25, .25, 1}, {.25, .25, -2}, 1 / 3.0),
    vertex("beside", {.75, .75, 1}, {.75, .75, -2}, never),
    vertex("at the end only", {.25, .25, 1}, {.25, .25, 0}, 1.0),
    vertex("not quite at the end", {.25, .25, 1}, {.25, .25, 0x1p-60}, never),
    vertex("hardly through", {.25, .25, 1}, {.25, .25, -0x1p-30}, 1 / (1 + 0x1p-30)),
    vertex("at the start only", {.25, .25, 0}, {.25, .25, 1}, 0.0),
    vertex("after the start", {.25, .25, 0x1p-40}, {.25, .25, 0x1p-40 - 1}, 0x1p-40),
    vertex("rests in it", {.25, .25, 0}, {.25, .25, 0}, 0.0),
    vertex("rests on a side", {.5, .5, 0}, {.5, .5, 0}, 0.0),
    vertex("rests beside a side", {.5, .5 + 0x1p-53, 0}, {.5, .5 + 0x1p-53, 0}, never),
    vertex("rests at a corner", {1, 0, 0}, {1, 0, 0}, 0.0),
    vertex("rests above it", {.25, .25, 0x1p-60}, {.25, .25, 0x1p-60}, never),
    vertex("grazes a side", {.5, .5, 1}, {.5, .5, -2}, 1 / 3.0),
    vertex("passes a side", {.5, .5 + 0x1p-53, 1}, {.5, .5 + 0x1p-53, -2}, never),
    vertex("slides in", {2, .25, 0}, {0, .25, 0}, 0.625),
    vertex("slides in over a corner", {-1, -2, 0}, {2, 4, 0}, 1 / 3.0),
    vertex("slides past a corner", {2, -1, 0}, {0, 1 + 0x1p-52, 0}, never),
    vertex("slides over a corner only", {2, -1, 0}, {0, 1, 0}, 0.5),
    vertex("slides along a side's line", {0, 3, 0}, {0, 0, 0}, 2 / 3.0),
    vertex("stops on a side's line", {0, 3, 0}, {0, 1 + 0x1p-52, 0}, never),
    vertex("meets a side that turns", {0, -.5, 0}, {1, -.5, 0}, std::numbers::sqrt2 / 2,
           {1, -1, 0}),
    vertex("root of a half", {0, .125, .5}, {1, .125, .5}, std::numbers::sqrt2 / 2, raised),
    vertex("touches twice at once", {0, .125, -.0625}, {1, .125, .4375}, 0.25, raised),
    vertex("nearly touches", {0, .125, -.0625 - 0x1p-50}, {1, .125, .4375 - 0x1p-50}, never,
           raised),
    vertex("touches twice", {0, .125, -.0625 + 0x1p-50}, {1, .125, .4375 + 0x1p-50}, .25 - 0x1p-25,
           raised),
    {"root of t^3 + t^2 = 1",  // a face in the plane (1 + t) z = t x + (1 + t) t y, a vertex at (-t, t, 1 - t)
     {{{{0, 0, 1}, {-4, -4, 0}, {8, -4, 0}, {-4, 8, 0}}},
      {{{-1, 1, 0}, {-8, -4, -8}, {16, -4, 4}, {-8, 8, 4}}},
      false},
     0.75487766624669276},
    edge("edges, a third", {{{0, -1, 1}, {0, 1, 1}}}, {{{0, -1, -2}, {0, 1, -2}}}, 1 / 3.0),
    edge("parallel", {{{-1, 0, 1}, {3, 0, 1}}}, {{{-1, 0, -2}, {3, 0, -2}}}, 1 / 3.0),
    edge("parallel, beside", {{{-1, 0x1p-60, 1}, {1, 0x1p-60, 1}}},
         {{{-1, 0x1p-60, -1}, {1, 0x1p-60, -1}}}, never),
    edge("in one line", {{{3, 0, 0}, {5, 0, 0}}}, {{{0, 0, 0}, {2, 0, 0}}}, 2 / 3.0),
    edge("in one line, apart", {{{3, 0, 0}, {5, 0, 0}}}, {{{1 + 0x1p-52, 0, 0}, {2, 0, 0}}}, never),
    edge("rest end to end", {{{1, 0, 0}, {2, 0, 0}}}, {{{1, 0, 0}, {2, 0, 0}}}, 0.0),
    edge("move away end to end", {{{1, 0, 0}, {2, 0, 0}}}, {{{2, 0, 0}, {3, 0, 0}}}, 0.0),
    edge("turn in one plane", {{{0, 1, 0}, {0, 2, 0}}}, {{{1, -1, 0}, {-1, 2, 0}}}, 0.5),
    edge("two points", {{{-1, 0, 1}, {-1, 0, 1}}}, {{{-1, 0, -2}, {-1, 0, -2}}}, 1 / 3.0),
};

/// Returns a query with other numbers of the axes and of the vertices, times 2^exponent.
MovingQuery changed(const MovingQuery& query, int turns, int exponent)
{
    MovingQuery other = query;
    for (int turn = 0; turn < turns; ++turn)
        for (Four* const four : {&other.from, &other.to}) {
            for (WidePoint& p : *four)
                p = {p.y, p.z, p.x};
            std::rotate(four->begin() + (query.of_edges ? 0 : 1), four->begin() + 2, four->end());
        }
    for (Four* const four : {&other.from, &other.to})
        for (WidePoint& p : *four)
            p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
    return other;
}

void expect_time(const std::optional<ImpactTime>& found, std::optional<double> time)
{
    ASSERT_EQ(found.has_value(), time.has_value());
    if (!found)
        return;
    EXPECT_LE(found->no_sooner, *time * (1 + 0x1p-52));
    EXPECT_GE(found->no_later, *time * (1 - 0x1p-52));
    EXPECT_LE(found->no_later - found->no_sooner, 1e-12);
}

class ImpactTimes : public Needing<testing::Test, cgal_absent> {};

TEST_F(ImpactTimes, AreThoseByHandAtAnyScale)
{
    for (int turns = 0; turns < 3; ++turns)
        for (const int exponent : {0, -1010, 1018}) {
            std::vector<MovingQuery> queries;
            for (const ByHand& one : by_hand)
                queries.push_back(changed(one.query, turns, exponent));
            const auto times = impact_times(queries), by_roots = impact_times_by_roots(queries);
            for (std::size_t k = 0; k < std::size(by_hand); ++k) {
                SCOPED_TRACE(std::string(by_hand[k].name) + " times 2^" + std::to_string(exponent));
                expect_time(times[k], by_hand[k].time);
                expect_time(by_roots[k], by_hand[k].time);
            }
        }
}

/// Returns the queries with their axes multiplied by these factors.
std::vector<MovingQuery> stretched(std::vector<MovingQuery> queries, WidePoint by)
{
    for (MovingQuery& query : queries)
        for (Four* const four : {&query.from, &query.to})
            for (WidePoint& p : *four)
                p = {p.x * by.x, p.y * by.y, p.z * by.z};
    return queries;
}

/// Motions between points of a lattice of 4^3.
struct Lattice {
    const char* name;
    WidePoint factors = {1, 1, 1};      ///< of the axes
    uint at_rest = 0;                   ///< of 4 vertices, about
    double first_slope = 0, slope = 0;  ///< times x + 2 y is added to z, in the end
    double lift = 0;                    ///< is added to the last z
};

const Lattice lattices[] = {
    {"anywhere"},
    {"half at rest", {1, 1, 1}, 2},
    {"at rest", {1, 1, 1}, 4},
    {"moving together", {1, 1, 1}, 4, 0, 0, 3},
    {"in one plane", {1, 1, 0}},
    {"in one plane, half at rest", {1, 1, 0}, 2},
    {"in a plane that moves", {1, 1, 0}, 0, 1, 1, 3},
    {"in a plane that turns", {1, 1, 0}, 4, 0, 1},
    {"in one line", {1, 0, 0}, 0, 1, 1},
};

std::vector<MovingQuery> queries_of(const Lattice& lattice, std::size_t count)
{
    std::mt19937 random(5);
    const auto whole = [&] { return static_cast<double>(random() % 4); };
    std::vector<MovingQuery> queries(count);
    for (std::size_t k = 0; k < count; ++k) {
        queries[k].of_edges = k % 2 == 1;
        for (std::size_t i = 0; i < 4; ++i) {
            queries[k].from[i] = {whole(), whole(), whole()};
            queries[k].to[i] = {whole(), whole(), whole()};
            if (random() % 4 < lattice.at_rest)
                queries[k].to[i] = queries[k].from[i];
        }
    }
    queries = stretched(std::move(queries), lattice.factors);
    for (MovingQuery& query : queries)
        for (std::size_t i = 0; i < 4; ++i) {
            WidePoint &p = query.from[i], &q = query.to[i];
            p.z += lattice.first_slope * (p.x + 2 * p.y);
            q.z += lattice.slope * (q.x + 2 * q.y) + lattice.lift;
        }
    return queries;
}

bool same_time(const std::optional<ImpactTime>& a, const std::optional<ImpactTime>& b)
{
    return a.has_value() == b.has_value() &&
           (!a || (a->no_sooner <= b->no_later && b->no_sooner <= a->no_later));
}

bool is_precise(const std::optional<ImpactTime>& a)
{
    return !a || (0 <= a->no_sooner && a->no_sooner <= a->no_later && a->no_later <= 1 &&
                  a->no_later - a->no_sooner <= 1e-12);
}

std::size_t touching_of(const std::vector<std::optional<ImpactTime>>& times)
{
    return static_cast<std::size_t>(
        std::ranges::count_if(times, [](const auto& one) { return one.has_value(); }));
}

void expect_those_by_roots(const std::vector<std::optional<ImpactTime>>& times,
                           const std::vector<std::optional<ImpactTime>>& by_roots)
{
    std::size_t wrong = 0;
    for (std::size_t k = 0; k < times.size(); ++k)
        wrong += same_time(times[k], by_roots[k]) && is_precise(times[k]) && is_precise(by_roots[k])
                     ? 0
                     : 1;
    EXPECT_EQ(wrong, 0u);
}

// Stretching changes no time. Factors of 50 bits leave it to exact numbers what is zero, as do those over the whole range of doubles.
TEST_F(ImpactTimes, OnLatticesAreThoseByRootsAloneHoweverStretched)
{
    constexpr std::size_t count = 1000;
    Checked checked;
    for (const Lattice& lattice : lattices) {
        SCOPED_TRACE(lattice.name);
        const auto queries = queries_of(lattice, count);
        const auto by_roots = impact_times_by_roots(queries);
        EXPECT_GT(touching_of(by_roots), 10u);
        EXPECT_LT(touching_of(by_roots), count - 10);
        for (const WidePoint by :
             {WidePoint{1, 1, 1}, WidePoint{0x1p-1074, 1, 0x1p1000},
              WidePoint{0x1.23456789abcdp-3, 0x1.fedcba987655p0, 0x1.5a5a5a5a5a5bp2}})
            expect_those_by_roots(impact_times(stretched(queries, by), &checked), by_roots);
    }
    EXPECT_EQ(checked.all, 3 * count * std::size(lattices));
    EXPECT_GT(checked.by_roots, count);
}

TEST_F(ImpactTimes, OfMotionsAnywhereOrInAPlaneAreThoseByRootsAndHardlyNeedOne)
{
    constexpr std::size_t count = 1000;
    std::mt19937_64 random(5);
    const auto in_cube = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
    for (const bool is_flat : {false, true}) {
        std::vector<MovingQuery> queries(count);
        for (std::size_t k = 0; k < count; ++k) {
            queries[k].of_edges = k % 2 == 1;
            for (Four* const four : {&queries[k].from, &queries[k].to})
                for (WidePoint& p : *four) {
                    p = {in_cube(), in_cube(), in_cube()};
                    p.z = is_flat ? p.x : p.z;
                }
        }
        const auto by_roots = impact_times_by_roots(queries);
        EXPECT_GT(touching_of(by_roots), 50u);
        for (const double by : {1.0, 0x1p1000}) {
            Checked checked;
            expect_those_by_roots(impact_times(stretched(queries, {by, by, by}), &checked),
                                  by_roots);
            EXPECT_LT(checked.by_roots, 5u) << by << is_flat;
        }
    }
}

/// Returns for each query whether its features touch at its start, by the oracle of one moment.
std::vector<bool> touch_at_start(const std::vector<MovingQuery>& queries)
{
    std::vector<Point> points;
    std::vector<Face> faces;
    std::vector<Pair> pairs;
    for (const MovingQuery& query : queries) {
        const auto v = static_cast<uint>(points.size()), f = static_cast<uint>(faces.size());
        for (const WidePoint& p : query.from)
            points.push_back(
                {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
        faces.push_back(query.of_edges ? Face{v, v + 1, v + 1} : Face{v, v, v});
        faces.push_back(query.of_edges ? Face{v + 2, v + 3, v + 3} : Face{v + 1, v + 2, v + 3});
        pairs.push_back({f, f + 1});
    }
    const PairList found = intersecting_pairs(points, faces, pairs, false);
    std::vector<bool> touch;
    for (const Pair pair : pairs)
        touch.push_back(std::ranges::binary_search(found.pairs(), pair));
    return touch;
}

TEST_F(ImpactTimes, OnLatticesAgreeWithTheOracleOfOneMomentAndWithTheMotionBack)
{
    for (const Lattice& lattice : lattices) {
        SCOPED_TRACE(lattice.name);
        auto queries = queries_of(lattice, 4000);
        const auto there = impact_times(queries);
        const auto first = touch_at_start(queries);
        for (MovingQuery& query : queries)
            std::swap(query.from, query.to);
        const auto back = impact_times(queries);
        const auto last = touch_at_start(queries);
        std::size_t wrong = 0;
        for (std::size_t k = 0; k < queries.size(); ++k) {
            const bool at_once = there[k] && there[k]->no_sooner == 0;
            wrong += back[k].has_value() == there[k].has_value() && first[k] == at_once &&
                             (there[k] || !last[k])
                         ? 0
                         : 1;
        }
        EXPECT_EQ(wrong, 0u);
    }
}

}  // namespace
}  // namespace bvhbench
