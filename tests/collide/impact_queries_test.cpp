// SPDX-License-Identifier: MIT
//
// Methods that answer queries of moving points alone: those with bounds on their errors miss nothing and are never late, against exact times.
#include <cmath>
#include <random>

#include "collide/moving/impact_queries.h"
#include "collide/oracles/swept_reference.h"
#include "tests/collide/narrow_testing.h"

namespace bvhbench {
namespace {

using Coordinate = double WidePoint::*;
constexpr Coordinate axes[] = {&WidePoint::x, &WidePoint::y, &WidePoint::z};

std::vector<double> times_of(const QueryMethod& method, std::span<const MovingQuery> queries,
                             std::uint64_t* cut_short = nullptr, double separation = 0)
{
    ImpactQueries phase(bench().programs, method, separation);
    phase.load(queries, 2, bench().queue);
    phase.query(bench().queue);
    bench().queue.finish();
    if (cut_short != nullptr)
        *cut_short = phase.cut_short(bench().queue);
    return phase.times(bench().queue);
}

const QueryMethod& method_called(std::string_view name)
{
    return *std::ranges::find(query_methods(), name, &QueryMethod::name);
}

/// Coordinates of a class of random queries: doubles around `at`, `size` apart; on a lattice, where degenerate motions are common.
struct Class {
    const char* name;
    double at, size;
    bool on_lattice;
};

constexpr Class classes[] = {{"usual", 0, 1, false},         {"lattice", 0, 1, true},
                             {"far away", 1e9, 1e-3, false}, {"tiny", 0, 0x1p-700, true},
                             {"huge", 0, 0x1p800, false},    {"denormal", 0, 0x1p-1070, true}};

std::vector<MovingQuery> random_queries(const Class& of, bool of_edges, std::size_t count)
{
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> share(-1, 1);
    std::uniform_int_distribution<int> place(-2, 2);
    std::vector<MovingQuery> queries(count, {.from = {}, .to = {}, .of_edges = of_edges});
    for (MovingQuery& query : queries)
        for (auto* points : {&query.from, &query.to})
            for (WidePoint& p : *points)
                for (const Coordinate axis : axes)
                    p.*axis = of.at + of.size * (of.on_lattice ? place(random) : share(random));
    return queries;
}

/// Returns the answers of the narrow phase between two frames to queries in a scene of this size, whose vertices are kept in doubles.
std::vector<double> times_of_step(std::string_view method, std::span<const MovingQuery> queries,
                                  double size, double separation = 0)
{
    Mesh mesh;
    std::vector<WidePoint> from, to;
    for (const MovingQuery& query : queries) {
        const auto v = static_cast<uint>(from.size());
        from.insert(from.end(), query.from.begin(), query.from.end());
        to.insert(to.end(), query.to.begin(), query.to.end());
        mesh.faces.push_back(query.of_edges ? Face{v, v + 1, v + 1} : Face{v, v, v});
        mesh.faces.push_back(query.of_edges ? Face{v + 2, v + 3, v + 3}
                                            : Face{v + 1, v + 2, v + 3});
    }
    mesh.points.resize(from.size());  // floats, which nothing reads
    Candidates candidates(mesh, neighbours(mesh));
    upload_wide(candidates.input, bench().device, bench().queue, from, to);
    NarrowPhase narrow(bench().programs, {.method = method,
                                          .swept_size = static_cast<float>(std::min(size, 1e30)),
                                          .separation = separation,
                                          .is_wide = true});
    narrow.reserve(queries.size());
    contacts_found(narrow, candidates);
    const std::vector<Pair> pairs = narrow.contacts(bench().queue);
    const std::vector<float> times = narrow.impact_times(bench().queue);
    std::vector<double> answers(queries.size(), no_impact);
    for (std::size_t k = 0; k < pairs.size(); ++k)
        answers[pairs[k].a / 2] = times[k];
    return answers;
}

TEST(ImpactQueries, WithBoundsMissNothingAndAreNeverLate)
{
    if (!has_exact_reference)
        GTEST_SKIP() << "built without CGAL: there is no reference";
    for (const Class& of : classes)
        for (const auto& [of_edges, share] : {std::pair(false, 0.0), std::pair(true, 0.0),
                                              std::pair(false, 0.1), std::pair(true, 1e-9)}) {
            const std::vector<MovingQuery> queries = random_queries(of, of_edges, 1500);
            const double separation = share * of.size;
            auto right = impact_times(queries, nullptr, separation);
            for (auto& time : right)  // of which nothing is known
                if (time && time->no_later > 1)
                    time.reset();
            const auto expect_right = [&](std::string_view method, const std::vector<double>& found,
                                          bool misses_none, bool is_precise) {
                SCOPED_TRACE(testing::Message() << of.name << (of_edges ? " edges " : " faces ")
                                                << share << ' ' << method);
                std::size_t touching = 0, missed = 0, late = 0, false_ones = 0, near = 0;
                for (std::size_t k = 0; k < queries.size(); ++k) {
                    const bool is_found = found[k] <= 1;
                    EXPECT_TRUE(is_found ? found[k] >= 0 : found[k] == no_impact) << found[k];
                    touching += right[k] ? 1 : 0;
                    missed += right[k] && !is_found ? 1 : 0;
                    late += right[k] && is_found && found[k] > right[k]->no_later ? 1 : 0;
                    false_ones += !right[k] && is_found ? 1 : 0;
                    near += right[k] && found[k] > right[k]->no_sooner - 1e-4 ? 1 : 0;
                }
                const std::size_t apart = queries.size() - touching;
                EXPECT_GT(touching, 100u);
                EXPECT_GT(apart, 100u);
                if (misses_none) {
                    EXPECT_EQ(missed, 0u);
                    EXPECT_EQ(late, 0u);
                }
                // Only the smallest coordinates are out of the range in which bounds hold.
                if (of.size > 0x1p-900 && is_precise) {
                    EXPECT_LT(false_ones, apart / 20);
                    EXPECT_GT(near, touching * 9 / 10);
                }
            };
            for (const QueryMethod& method : query_methods())
                if (separation == 0 || method.can_separate())
                    expect_right(method.name, times_of(method, queries, nullptr, separation),
                                 method.misses_none(),
                                 method.answer != 2 && method.tolerance <= 1e-6);
                else
                    EXPECT_THROW(times_of(method, queries, nullptr, separation), BadUsage);
            for (const char* const step : {"ccd-f64-1e-4", "ccd-f64-1e-6"})
                expect_right(step, times_of_step(step, queries, of.size, separation), true,
                             share == 0 || std::string_view(step).ends_with("6"));
        }
}

/// A query that touches at the time of `time`, by whole numbers: the middle of two edges, or a corner's mean of a face's, on the way of
/// points that go on by whole steps. Each axis has a scale of its own.
MovingQuery touching_query(std::mt19937_64& random, bool of_edges, double& time)
{
    std::uniform_int_distribution<int> place(-4, 4), halvings(0, 6), power(-40, 40);
    const int s = halvings(random), steps = 1 << s,
              step = std::uniform_int_distribution(0, steps)(random);
    MovingQuery query{.from = {}, .to = {}, .of_edges = of_edges};
    for (const Coordinate axis : axes) {
        std::array<int, 4> at{};
        for (int& x : at)
            x = 4 * place(random);
        if (of_edges)
            at[3] = at[0] + at[1] - at[2];
        else
            at[0] = (at[1] + at[2] + 2 * at[3]) / 4;
        const double scale = std::ldexp(1.0, power(random));
        for (std::size_t k = 0; k < 4; ++k) {
            const int way = place(random);
            query.from[k].*axis = scale * (at[k] - step * way);
            query.to[k].*axis = scale * (at[k] + (steps - step) * way);
        }
    }
    time = double(step) / steps;
    return query;
}

TEST(ImpactQueries, WithBoundsFindTouchesThatArithmeticMayLose)
{
    std::mt19937_64 random(3);
    for (const bool of_edges : {false, true}) {
        std::vector<MovingQuery> queries;
        std::vector<double> times(10000);
        for (double& time : times)
            queries.push_back(touching_query(random, of_edges, time));
        for (const QueryMethod& method : query_methods()) {
            if (method.answer == 2)  // takes long, and is conservative but for rounding
                continue;
            const std::vector<double> found = times_of(method, queries);
            std::size_t late = 0;
            for (std::size_t k = 0; k < times.size(); ++k)
                late += found[k] > times[k] ? 1 : 0;
            EXPECT_EQ(late > 0, !method.misses_none()) << method.name << late;
        }
        const auto found = times_of_step("ccd-f64-1e-6", queries, 1);
        EXPECT_TRUE(std::ranges::equal(found, times, std::less_equal{}));
    }
}

struct Touching {
    bool of_edges;
    double time;
    double at[24];  ///< x, y and z of four vertices in the first frame, and in the last
};

/// Touches that are lost if the volume's error or the components' is taken from one frame, or from half of the products.
constexpr Touching hard_touches[] = {
    {false, 0.0625, {0, -1,  10, 0, -1, 15, 0, -1,  11, 1,   -5, 4,
                     0, -17, 10, 0, 15, 31, 0, -17, -5, -15, 11, 4}},
    {false, 0.0625, {-4, -1, 4,   -4, -1, 2, -2, 1, 0,  -4, -1, 2,
                     28, 31, -28, -4, 31, 2, -2, 1, 32, 28, 31, 2}},
    {true, 0.0625, {0x1.ap+23,  0x1.14p+25,   -0x1.2bp+25, 0x1.7p+24,  0x1.338p+25,  0x1.19p+24,
                    0x1.7p+24,  0x1.338p+25,  0x1.1ap+24,  0x1.ap+23,  0x1.138p+25,  -0x1.2bp+25,
                    0x1.3ap+27, -0x1.96p+26,  0x1.814p+27, 0x1.4ep+27, -0x1.824p+26, 0x1.f12p+27,
                    0x1.4ep+27, -0x1.824p+26, 0x1.ef4p+27, 0x1.3ap+27, -0x1.924p+26, 0x1.814p+27}},
    {true, 0.75, {0, -1, 5, 4, 1, 1, 4, -2, 1, 0, -1, 2, 0, -1, 1, 0, 1, 1, 0, 2, 1, 0, -1, 2}},
    {false, 0.5, {4, 3, 2, -4, 1, 2, 1, 1, 2, 2, 3, 2, 0, -1, 2, 8, 1, 2, -5, -1, 2, -2, 1, -2}},
    {false, 0.5, {237, 112, -167, 243, 116, -159, 241, 112, -167, 241, 112, -167,
                  -8,  0,   -8,   -2,  4,   -8,   4,   -8,  -16,  -12, 0,   -8}},
    {false, 0.5, {3, -4, 2, 0, -4, 4,  -4, 8, -4, 2, -4, 8,
                  3, -4, 2, 8, -4, -4, 4,  0, -4, 2, -4, 0}},
    {false, 0.125, {1, -2, 1, -1, 0,  1,   17,   -17, 1, 2, 2, -13,
                    1, -2, 1, -1, 16, -23, -111, 103, 1, 2, 2, 91}},
    {false, 1, {1, -1, -19, 20, 8, -16, -4, -8, -24, 4, -8, 16,
                2, -4, -22, 20, 8, -16, -4, -8, -24, 4, -8, 16}}};

TEST(ImpactQueries, WithBoundsFindTouchesThatHalfABoundLoses)
{
    for (const Touching& one : hard_touches) {
        MovingQuery query{.from = {}, .to = {}, .of_edges = one.of_edges};
        for (std::size_t k = 0; k < 12; ++k) {
            query.from[k / 3].*axes[k % 3] = one.at[k];
            query.to[k / 3].*axes[k % 3] = one.at[12 + k];
        }
        for (const QueryMethod& method : query_methods())
            if (method.misses_none()) {
                EXPECT_LE(times_of(method, {&query, 1})[0], one.time) << method.name;
            }
    }
}

TEST(ImpactQueries, AnswerCasesByHand)
{
    // A vertex on its way through a face at rest, beside it, and at rest on it.
    const std::array<WidePoint, 3> face = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    const auto vertex = [&](WidePoint from, WidePoint to) {
        return MovingQuery{.from = {from, face[0], face[1], face[2]},
                           .to = {to, face[0], face[1], face[2]}};
    };
    const std::vector<MovingQuery> queries = {vertex({.25, .25, 1}, {.25, .25, -3}),
                                              vertex({.75, .75, 1}, {.75, .75, -3}),
                                              vertex({.25, .25, 0}, {.25, .25, 0})};
    for (const QueryMethod& method : query_methods()) {
        SCOPED_TRACE(method.name);
        const std::vector<double> found = times_of(method, queries);
        const double off =
            method.answer == 2 ? 0.03 : method.tolerance + (method.real_bits == 32 ? 1e-5 : 1e-15);
        EXPECT_NEAR(found[0], 0.25, off);
        EXPECT_EQ(found[1], no_impact);
        EXPECT_EQ(found[2], 0);
    }
    std::uint64_t cut_short = 1;
    times_of(method_called("ccd-f64-1e-6"), queries, &cut_short);
    EXPECT_EQ(cut_short, 0u);
}

}  // namespace
}  // namespace bvhbench
