// SPDX-License-Identifier: MIT
//
// The narrow phase between two frames misses nothing that touches, and what it finds besides comes near: by hand, and on random
// motions against exact arithmetic.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <random>

#include "collide/oracles/swept_reference.h"
#include "geometry/error.h"
#include "scenes/generate/vector.h"
#include "tests/collide/narrow_testing.h"

namespace bvhbench {
namespace {

using Four = std::array<Point, 4>;

/// Pairs of features, each of four vertices of its own: a vertex and a face, or two edges.
struct Motions {
    std::vector<Point> from, to;
    std::vector<Face> faces;
    std::vector<Pair> pairs;

    void add(bool of_edges, const Four& first, const Four& last)
    {
        const auto v = static_cast<uint>(from.size()), f = static_cast<uint>(faces.size());
        from.insert(from.end(), first.begin(), first.end());
        to.insert(to.end(), last.begin(), last.end());
        faces.push_back(of_edges ? Face{v, v + 1, v + 1} : Face{v, v, v});
        faces.push_back(of_edges ? Face{v + 2, v + 3, v + 3} : Face{v + 1, v + 2, v + 3});
        pairs.push_back({f, f + 1});
    }
    bool is_of_edges(std::size_t k) const { return faces[2 * k].a != faces[2 * k].b; }
};

/// Returns the time of each pair that is found.
std::map<Pair, float> found_by(std::string_view method, KernelForm form, const Motions& all,
                               float size, bool is_wide = false, double separation = 0)
{
    const Mesh mesh = {all.from, all.faces};
    Candidates candidates(mesh, all.pairs);
    upload_end(candidates.input, bench().device, bench().queue, all.to);
    const auto wide = [](Point p) { return WidePoint{p.x, p.y, p.z}; };
    std::vector<WidePoint> from(all.from.size()), to(all.to.size());
    std::ranges::transform(all.from, from.begin(), wide);
    std::ranges::transform(all.to, to.begin(), wide);
    if (is_wide)
        upload_wide(candidates.input, bench().device, bench().queue, from, to);
    NarrowPhase narrow(bench().programs, {.method = method,
                                          .form = form,
                                          .capacity = 1,
                                          .swept_size = size,
                                          .separation = separation,
                                          .is_wide = is_wide});
    narrow.reserve(all.faces.size());
    contacts_found(narrow, candidates);
    const std::vector<Pair> pairs = narrow.contacts(bench().queue);
    const std::vector<float> times = narrow.impact_times(bench().queue);
    std::map<Pair, float> found;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        found.emplace(pairs[k], times[k]);
        EXPECT_TRUE(times[k] >= 0 && times[k] <= 1) << times[k];
    }
    return found;
}

struct ByHand {
    const char* name;
    bool of_edges;
    Four from, to;
    std::optional<double> time;  ///< when they first touch
};

constexpr std::optional<double> never;

/// A vertex on its way past a face at rest.
ByHand vertex(const char* name, Point from, Point to, std::optional<double> time,
              std::array<Point, 3> face = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}})
{
    const auto& [a, b, c] = face;
    return {name, false, {from, a, b, c}, {to, a, b, c}, time};
}

/// An edge on its way past an edge at rest.
ByHand edge(const char* name, std::array<Point, 2> from, std::array<Point, 2> to,
            std::optional<double> time, std::array<Point, 2> other = {{{-1, 0, 0}, {1, 0, 0}}})
{
    const auto& [left, right] = other;
    return {name, true, {left, right, from[0], from[1]}, {left, right, to[0], to[1]}, time};
}

constexpr std::array<Point, 3> without_area = {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}},
                               of_one_point = {};

const ByHand by_hand[] = {
    vertex("head on", {.25f, .25f, 1}, {.25f, .25f, -1}, 0.5),
    vertex("beside", {.75f, .75f, 1}, {.75f, .75f, -1}, never),
    vertex("stops before", {.25f, .25f, 1}, {.25f, .25f, .125f}, never),
    vertex("at the end only", {.25f, .25f, 1}, {.25f, .25f, 0}, 1.0),
    vertex("at the start only", {.25f, .25f, 0}, {.25f, .25f, 1}, 0.0),
    vertex("grazes a corner", {1, 0, 1}, {1, 0, -3}, 0.25),
    vertex("grazes a side", {.5f, .5f, 1}, {.5f, .5f, -1}, 0.5),
    vertex("slides in", {2, .25f, 0}, {0, .25f, 0}, 0.625),
    vertex("slides past", {2, 2, 0}, {-1, 2, 0}, never),
    vertex("hits a face without area", {1, 0, 1}, {1, 0, -1}, 0.5, without_area),
    vertex("passes a face without area", {1, .5f, 1}, {1, .5f, -1}, never, without_area),
    vertex("hits a point", {0, 0, 1}, {0, 0, -1}, 0.5, of_one_point),
    vertex("passes a point", {.5f, 0, 1}, {.5f, 0, -1}, never, of_one_point),
    vertex("rests in it", {.25f, .25f, 0}, {.25f, .25f, 0}, 0.0),
    vertex("rests above it", {.25f, .25f, .125f}, {.25f, .25f, .125f}, never),
    {"moves along",
     false,
     {{{.25f, .25f, .125f}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
     {{{.25f, .25f, 8.125f}, {0, 0, 8}, {1, 0, 8}, {0, 1, 8}}},
     never},
    {"is met",
     false,
     {{{.25f, .25f, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
     {{{.25f, .25f, 1}, {0, 0, 4}, {1, 0, 4}, {0, 1, 4}}},
     0.25},
    edge("edges cross", {{{0, -1, 1}, {0, 1, 1}}}, {{{0, -1, -1}, {0, 1, -1}}}, 0.5),
    edge("edges end before", {{{2, -1, 1}, {2, 1, 1}}}, {{{2, -1, -1}, {2, 1, -1}}}, never),
    edge("edges end there", {{{1, -1, 1}, {1, 1, 1}}}, {{{1, -1, -1}, {1, 1, -1}}}, 0.5),
    edge("parallel", {{{-1, 0, 1}, {1, 0, 1}}}, {{{-1, 0, -1}, {1, 0, -1}}}, 0.5),
    edge("parallel, beside", {{{-1, .5f, 1}, {1, .5f, 1}}}, {{{-1, .5f, -1}, {1, .5f, -1}}}, never),
    edge("in one line", {{{2, 0, 0}, {3, 0, 0}}}, {{{0, 0, 0}, {1, 0, 0}}}, 0.5),
    edge("in one line, apart", {{{2, 0, 0}, {3, 0, 0}}}, {{{1.5f, 0, 0}, {2.5f, 0, 0}}}, never),
    edge("in one plane", {{{0, 1, 0}, {0, 2, 0}}}, {{{0, -1, 0}, {0, 0, 0}}}, 0.5),
    edge("at the end only, edges", {{{0, -1, 1}, {0, 1, 1}}}, {{{0, -1, 0}, {0, 1, 0}}}, 1.0),
    edge("an edge without length", {{{0, 0, 1}, {0, 0, 1}}}, {{{0, 0, -1}, {0, 0, -1}}}, 0.5),
    edge("two of them", {{{0, 0, 1}, {0, 0, 1}}}, {{{0, 0, -1}, {0, 0, -1}}}, 0.5, {}),
    edge("turns into it", {{{0, 1, -1}, {0, 1, 1}}}, {{{0, 1, -1}, {0, -1, 1}}}, 1.0),
};

Point moved(Point p, float scale, float by)
{
    return {scale * (p.x + by), scale * (p.y + by), scale * (p.z + by)};
}

/// Returns all cases, scaled after a translation. Both must leave the coordinates exact.
Motions cases(float scale, float by)
{
    Motions all;
    for (const ByHand& one : by_hand) {
        Four from = one.from, to = one.to;
        for (Four* const four : {&from, &to})
            for (Point& p : *four)
                p = moved(p, scale, by);
        all.add(one.of_edges, from, to);
    }
    return all;
}

class Impacts : public testing::TestWithParam<KernelForm> {};

TEST_P(Impacts, ByHandAreFoundWhereverTheyAreAndBeforeTheyHappen)
{
    for (const auto& [scale, by] : {std::pair(1.0f, 0.0f), std::pair(1.0f, 1024.0f),
                                    std::pair(0x1p-90f, -512.0f), std::pair(0x1p60f, 3.0f)})
        for (const NarrowMethod& method : narrow_methods(NarrowOf::step)) {
            const Motions all = cases(scale, by);
            const auto found = found_by(method.name, GetParam(), all, 2 * scale);
            for (std::size_t k = 0; k < std::size(by_hand); ++k) {
                SCOPED_TRACE(std::string(by_hand[k].name) + ' ' + std::string(method.name));
                const auto one = found.find(all.pairs[k]);
                ASSERT_EQ(one != found.end(), by_hand[k].time.has_value()) << scale << ' ' << by;
                if (one == found.end())
                    continue;
                EXPECT_LE(one->second, *by_hand[k].time);
                EXPECT_GE(one->second, *by_hand[k].time - 2 * method.tolerance - 1e-3);
            }
        }
}

// The bounds on rounding do not hold for differences this small or large.
TEST_P(Impacts, AreAllFoundOutsideTheRangeOfTheBounds)
{
    for (const float scale : {0x1p-140f, 0x1p-110f, 0x1p105f, 0x1p124f}) {
        EXPECT_EQ(found_by("ccd-1e-6", GetParam(), cases(scale, 0), scale).size(),
                  std::size(by_hand));
        EXPECT_EQ(  // in doubles they do
            found_by("ccd-f64-1e-6", GetParam(), cases(scale, 0), scale).size(),
            found_by("ccd-f64-1e-6", GetParam(), cases(1, 0), 1).size());
    }
}

/// Returns the distance of the features of pair k at a time: that of the origin from the hull of the differences of vertices,
/// whose nearest point is on a side or within.
double distance(const Motions& all, std::size_t k, double time)
{
    const auto at = [&](std::size_t i) {
        const Point p = all.from[4 * k + i], q = all.to[4 * k + i];
        return vector_of(p) + time * (vector_of(q) - vector_of(p));
    };
    const bool of_edges = all.is_of_edges(k);
    const std::array hull =
        of_edges ? std::array{at(2) - at(0), at(2) - at(1), at(3) - at(1), at(3) - at(0)}
                 : std::array{at(1) - at(0), at(2) - at(0), at(3) - at(0), at(3) - at(0)};
    const Vector normal = cross(hull[1] - hull[0], hull[2] - hull[0]);
    double least = length(hull[0]);
    bool is_inside = dot(normal, normal) > 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vector from = hull[i], to = hull[(i + 1) % 4], side = to - from;
        const double share =
            dot(side, side) > 0 ? std::clamp(-dot(from, side) / dot(side, side), 0.0, 1.0) : 0;
        const Vector nearest = from + share * side;
        least = std::min(least, length(nearest));
        is_inside = is_inside && dot(cross(from, to), normal) >= 0;
    }
    return is_inside ? std::min(least, std::abs(dot(normal, hull[0])) / length(normal)) : least;
}

/// Returns the least distance of pair k over the step, at most half a thousandth of the longest way too large.
double least_distance(const Motions& all, std::size_t k)
{
    double least = distance(all, k, 1);
    for (int step = 0; step < 1000; ++step)
        least = std::min(least, distance(all, k, step / 1000.0));
    return least;
}

/// A class of random motions, in a cube of this size. `first` returns a coordinate, `last` what it is in the last frame.
struct Class {
    const char* name;
    uint count;
    float size;
    std::function<float(std::mt19937&)> first;
    std::function<float(std::mt19937&, float)> last;
    bool is_flat = false;  ///< z is 0
    /// The vertex moves onto the face, or the second edge's middle onto the first's.
    bool ends_in_touch = false;
};

float uniform(std::mt19937& random) { return std::uniform_real_distribution<float>(-1, 1)(random); }
float twentieth_bit(std::mt19937& random)
{
    return std::ldexp(static_cast<float>(random() % (1u << 20)), -20);
}
float whole(std::mt19937& random) { return static_cast<float>(random() % 4); }

const Class classes[] = {
    {"anywhere", 10000, 2, uniform, [](std::mt19937& random, float) { return uniform(random); }},
    {"slow", 10000, 2, uniform,
     [](std::mt19937& random, float x) { return x + 0.1f * uniform(random); }},
    {"tiny", 2000, 2e-25f, [](std::mt19937& random) { return 1e-25f * uniform(random); },
     [](std::mt19937& random, float) { return 1e-25f * uniform(random); }},
    {"lattice", 4000, 3, whole, [](std::mt19937& random, float) { return whole(random); }},
    {"still lattice", 4000, 3, whole,
     [](std::mt19937& random, float x) { return random() % 4 == 0 ? whole(random) : x; }},
    {"far lattice", 2000, 3, [](std::mt19937& random) { return 4194304 + whole(random); },
     [](std::mt19937& random, float) { return 4194304 + whole(random); }},
    {"flat lattice", 4000, 3, whole, [](std::mt19937& random, float) { return whole(random); },
     true},
    {"ends in touch", 4000, 2, twentieth_bit,
     [](std::mt19937& random, float) { return twentieth_bit(random); }, false, true},
};

Motions motions_of(const Class& of)
{
    std::mt19937 random(5);
    Motions all;
    for (uint k = 0; k < of.count; ++k) {
        Four from, to;
        for (std::size_t i = 0; i < 4; ++i) {
            from[i] = {of.first(random), of.first(random), of.is_flat ? 0 : of.first(random)};
            to[i] = {of.last(random, from[i].x), of.last(random, from[i].y),
                     of.is_flat ? 0 : of.last(random, from[i].z)};
        }
        const bool of_edges = k % 2 == 1;
        for (float Point::*const axis : {&Point::x, &Point::y, &Point::z}) {
            if (!of.ends_in_touch)
                break;
            const auto way = (from[0].*axis + from[1].*axis - from[2].*axis - from[3].*axis) / 2;
            for (std::size_t i = 0; i < 4; ++i)
                to[i].*axis = from[i].*axis + (of_edges && i >= 2 ? way : 0);
            if (!of_edges)
                to[0].*axis = (from[1].*axis + from[2].*axis + 2 * from[3].*axis) / 4;
        }
        all.add(of_edges, from, to);
    }
    return all;
}

/// Returns how many times of the oracle are wrong, of a seventh of the pairs: before a bracket features are farther apart than the
/// separation, and at its end they are not.
std::size_t wrong_brackets(const Motions& all, const Class& of, double separation)
{
    Input input;
    input.points = all.from, input.end_points = all.to, input.faces = all.faces;
    const auto times = impact_times(input, all.pairs, separation);
    const double slack = 1e-11 * (of.size + double{all.from[0].x});
    std::size_t wrong = 0, wide = 0;
    for (std::size_t k = 0; k < times.size(); k += 7) {
        const double since = times[k] ? times[k]->no_sooner : 1.0;
        for (int step = 0; step <= 20 && since > 0; ++step)
            wrong += distance(all, k, since * step / 20) < separation - slack ? 1 : 0;
        if (!times[k] || times[k]->no_later > 1)
            continue;
        wrong += distance(all, k, times[k]->no_later) > separation + slack ? 1 : 0;
        wide += times[k]->no_later - since > 1e-12 ? 1 : 0;
    }
    return wrong + (wide < 10 ? 0 : wide);
}

/// The minimum separations of tests, as shares of a scene's size: none, tiny, small, and of its own size.
class AnyImpacts : public testing::TestWithParam<std::tuple<KernelForm, double>> {};

TEST_P(AnyImpacts, AtRandomAreNeverMissedOrLateAndFalseOnesComeNear)
{
    if (!has_exact_reference)
        GTEST_SKIP() << "built without CGAL: there is no reference";
    const auto [form, share] = GetParam();
    for (const Class& of : classes) {
        const Motions all = motions_of(of);
        const double separation = share * of.size;
        const std::vector<Impact> touching =
            touching_on_the_way(all.from, all.to, all.faces, all.pairs, nullptr, separation);
        EXPECT_GT(pairs_of(touching).size(), 20u) << of.name;
        EXPECT_LT(pairs_of(touching, false).size(), 5u) << of.name;
        EXPECT_TRUE(share > 0 || (touching.size() == of.count) == of.ends_in_touch) << of.name;
        EXPECT_EQ(wrong_brackets(all, of, separation), 0u) << of.name;
        std::size_t found_before = of.count;
        for (const NarrowMethod& method : narrow_methods(NarrowOf::step)) {
            SCOPED_TRACE(std::string(of.name) + ' ' + std::string(method.name));
            auto found = found_by(method.name, form, all, of.size, false, separation);
            EXPECT_LE(found.size(), found_before);  // tolerances decrease
            found_before = found.size();
            std::size_t missed = 0, late = 0, far = 0;
            for (const Impact& one : touching) {
                const auto same = found.find(one.pair);
                missed += same == found.end() && one.no_later <= 1 ? 1 : 0;
                late += same != found.end() && double{same->second} > one.no_later ? 1 : 0;
                found.erase(one.pair);
            }
            const double sampled = of.size * std::sqrt(3.0) / 1000, rounded = of.size * 0x1p-16;
            for (const auto& [pair, time] : found)
                far += least_distance(all, pair.a / 2) >
                               separation + of.size * method.tolerance + sampled + rounded
                           ? 1
                           : 0;
            EXPECT_EQ(missed, 0u);
            EXPECT_EQ(late, 0u);
            EXPECT_LE(far, share > 0 ? 1u : 0u);  // a step of 64 may not tell
        }
    }
}

// Small enough for a simulated device that checks every memory access.
TEST_P(Impacts, OfFewPairsAreFound)
{
    const Motions few = cases(1, 0);
    EXPECT_GT(found_by("ccd-1e-4", GetParam(), few, 2).size(), 10u);
    const auto in_doubles = found_by("ccd-f64-1e-4", GetParam(), few, 2);
    EXPECT_GT(in_doubles.size(), 10u);
    EXPECT_EQ(found_by("ccd-f64-1e-4", GetParam(), few, 2, true), in_doubles);
}

TEST(ImpactPhase, IsForSweptBoxesAndOthersAreNot)
{
    const auto make = [](const NarrowOptions& options) { NarrowPhase(bench().programs, options); };
    EXPECT_THROW(make({.method = "ccd-1e-4"}), BadUsage);
    EXPECT_THROW(make({.method = "exact", .swept_size = 1}), BadUsage);
    EXPECT_THROW(make({.method = "ccd-1e-4", .swept_size = 1, .is_wide = true}), BadUsage);
    EXPECT_THROW(make({.method = "exact", .separation = 1}), BadUsage);
    EXPECT_THROW(make({.method = "ccd-1e-4", .swept_size = 1, .separation = -1}), BadUsage);
    EXPECT_THROW(make({.method = "ccd-1e-4", .swept_size = 1, .separation = HUGE_VAL}), BadUsage);
    EXPECT_THROW(make({.method = "ccd-f64-1e-4", .without_doubles = true, .swept_size = 1}),
                 Unavailable);
}

INSTANTIATE_TEST_SUITE_P(Forms, Impacts, testing::ValuesIn(both_forms), form_test_name);
INSTANTIATE_TEST_SUITE_P(Separations, AnyImpacts,
                         testing::Combine(testing::ValuesIn(both_forms),
                                          testing::Values(0.0, 1e-6, 0.05, 1.0)));

}  // namespace
}  // namespace bvhbench
