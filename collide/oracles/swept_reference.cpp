// SPDX-License-Identifier: MIT
//
// Two features of four vertices touch only when these are in one plane, which is when a polynomial of degree 3 in time is zero.
// Whether they touch at such a time follows from signs of polynomials of degree 1 and 2 (`meet`). Interval arithmetic that bisects
// the time decides nearly all pairs; algebraic numbers decide the rest. If vertices stay in one plane, that polynomial is zero at
// all times, and those signs alone decide; whole numbers tell where intervals cannot tell that it is.
#include "collide/oracles/swept_reference.h"

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "collide/oracles/first_touch.h"
#include "collide/oracles/first_within.h"
#include "collide/oracles/moving_features.h"
#include "geometry/cores.h"
#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

constexpr std::size_t at_once = 256;  ///< queries that a thread takes
constexpr int most_halvings = 41;     ///< of the time, in interval arithmetic
constexpr double precise = 0x1p-40;   ///< the most between the bounds of a time of impact

/// Looks for the first time at which the features touch, by intervals.
struct Search {
    const Polynomial<Interval, 3>& volume;
    const Areas<Interval>& areas;
    double finest;  ///< the most between the bounds of the time
    int undecided;  ///< how many intervals that are not halved further may remain undecided
    std::optional<double> no_sooner = {};
    double no_later = 0;  ///< if they touch

    /// Whether the features touch from `begin` to `end`, if intervals can tell. They do not touch before, or `no_sooner` tells.
    Truth during(double begin, double end, int halvings = most_halvings)
    {
        const SignDuring sign{Interval(begin, end)};
        const Sign side = sign(volume);
        if (CGAL::certainly(side != CGAL::ZERO))
            return false;
        const Truth meets = meet(areas, sign);
        if (CGAL::certainly_not(meets))
            return false;
        const Sign at_begin = SignDuring{begin}(volume), at_end = SignDuring{end}(volume);
        const Truth in_one_plane = (side == CGAL::ZERO) | (at_begin * at_end != CGAL::POSITIVE);
        const double latest = CGAL::certainly(side == CGAL::ZERO) ? begin : end;
        if (CGAL::certainly(meets & in_one_plane) && latest - no_sooner.value_or(begin) <= finest) {
            no_sooner = no_sooner.value_or(begin);
            no_later = latest;
            return true;
        }
        if (halvings == 0) {
            no_sooner = no_sooner.value_or(begin);
            --undecided;
            return Truth::indeterminate();
        }
        const double middle = begin + (end - begin) / 2;
        const Truth first = during(begin, middle, halvings - 1);
        if (CGAL::certainly(first) || undecided == 0)
            return first;
        return first | during(middle, end, halvings - 1);
    }
};

constexpr double WidePoint::*axes[] = {&WidePoint::x, &WidePoint::y, &WidePoint::z};

/// Makes a motion of numbers that `number` makes of the 24 coordinates.
template <class Number, class Make>
Motion<Number> motion_of(const MovingQuery& query, const Make& number)
{
    Motion<Number> all{query.of_edges, {}};
    for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Number first = number(query.from[k].*axes[axis]);
            all.at[k][axis].of = {first, number(query.to[k].*axes[axis]) - first};
        }
    return all;
}

/// A coordinate is `mantissa` * 2^exponent.
struct Parts {
    int exponent = 0;
    double mantissa;  ///< below 1, of 53 bits

    explicit Parts(double x) : mantissa(std::frexp(x, &exponent)) {}
};

/// Returns the least and the largest exponent of 0 and the coordinates.
std::pair<int, int> exponents(const MovingQuery& query)
{
    std::pair<int, int> range = {0, 0};
    for (const auto& four : {query.from, query.to})
        for (const WidePoint& p : four)
            for (const auto axis : axes) {
                range.first = std::min(range.first, Parts(p.*axis).exponent);
                range.second = std::max(range.second, Parts(p.*axis).exponent);
            }
    return range;
}

/// Returns the motion in multiples of a power of two.
Motion<Whole> in_whole_numbers(const MovingQuery& query)
{
    return motion_of<Whole>(query, [least = exponents(query).first](double x) {
        const Parts parts(x);
        return Whole(std::ldexp(parts.mantissa, 53)) << (parts.exponent - least);
    });
}

/// Returns the motion times `scale`. Rounding must be protected.
Motion<Interval> in_intervals(const MovingQuery& query, Interval scale)
{
    return motion_of<Interval>(query, [&](double x) { return Interval(x) * scale; });
}

/// Returns when the features of a query come within a distance first, to `finest`, nothing if they do not.
std::optional<ImpactTime> time_within(const MovingQuery& query, double distance, double finest)
{
    const auto search = [&] {
        const CGAL::Protect_FPU_rounding<true> upwards;
        double largest = distance;
        for (const auto& four : {query.from, query.to})
            for (const WidePoint& p : four)
                for (const auto axis : axes)
                    largest = std::max(largest, std::abs(p.*axis));
        const Interval scale = std::ldexp(1.0, std::min(1000, -Parts(largest).exponent));
        return FirstWithin(query, distance, in_intervals(query, scale), Interval(distance) * scale);
    };
    return search().find(finest);
}

/// Returns when the features of a query touch first, to `finest`, nothing if they do not.
std::optional<ImpactTime> impact_time(const MovingQuery& query, double finest, Checked& checked,
                                      double separation)
{
    if (separation > 0)
        return time_within(query, separation, finest);
    std::optional<Areas<Interval>> near;
    {
        const CGAL::Protect_FPU_rounding<true> upwards;
        const Interval scale = std::ldexp(1.0, -exponents(query).second);  // no product overflows
        const Motion<Interval> all = in_intervals(query, scale);
        Polynomial<Interval, 3> volume = all.volume();
        if (CGAL::certainly(SignDuring{{0, 1}}(volume) != CGAL::ZERO))
            return std::nullopt;
        near.emplace(all);
        Truth in_one_plane = volume.is_zero();
        if (CGAL::is_indeterminate(in_one_plane) &&
            CGAL::certainly_not(meet(*near, SignDuring{{0, 1}})))
            return std::nullopt;
        if (CGAL::is_indeterminate(in_one_plane))
            in_one_plane = in_whole_numbers(query).volume().is_zero();
        if (CGAL::certainly(in_one_plane))
            volume.of.fill(Interval(0));
        Truth at_start = Truth(CGAL::is_zero(volume.of[0]));
        if (!CGAL::certainly_not(at_start))
            at_start = at_start & meet(*near, SignDuring{0});
        if (CGAL::certainly(at_start))
            return ImpactTime{0, 0};
        // Features in one plane touch from the first time on for a while, before which an interval or two remain undecided. Where it is not
        // certain whether they do at the start, the search would end there.
        const bool is_flat = CGAL::certainly(in_one_plane);
        if (!is_flat || CGAL::certainly_not(at_start)) {
            Search search{volume, *near, finest, is_flat ? 4 : 1};
            const Truth touch = search.during(0, 1);
            if (CGAL::certainly_not(touch))
                return std::nullopt;
            if (CGAL::certainly(touch))
                return ImpactTime{*search.no_sooner, search.no_later};
        }
    }
    ++checked.by_roots;
    return first_touch(in_whole_numbers(query), &*near);
}

/// Calls work(k, ours) for each k below `count` on all cores; `ours` counts what is checked.
template <class Work>
void for_each(std::size_t count, Checked* checked, const Work& work)
{
    on_all_cores(count / at_once + 1, [&](std::size_t part) {
        Checked ours;
        for (std::size_t k = part * at_once; k < std::min(count, (part + 1) * at_once); ++k) {
            work(k, ours);
            ++ours.all;
        }
        if (checked != nullptr) {
            checked->all += ours.all;
            checked->by_roots += ours.by_roots;
        }
    });
}

WidePoint wide(Point p) { return {p.x, p.y, p.z}; }
WidePoint wide(WidePoint p) { return p; }

/// Returns the features of a pair as they move.
template <class P>
MovingQuery query_of(std::span<const P> points, std::span<const P> end_points,
                     std::span<const Face> faces, Pair pair)
{
    const Face a = faces[pair.a], b = faces[pair.b];
    const bool of_edges = b.b == b.c;
    const auto vertices = [&](std::span<const P> at) {
        return std::array{wide(at[a.a]), wide(at[of_edges ? a.b : b.a]),
                          wide(at[of_edges ? b.a : b.b]), wide(at[of_edges ? b.b : b.c])};
    };
    return {vertices(points), vertices(end_points), of_edges};
}

template <class P>
std::vector<Impact> touching_pairs(std::span<const P> points, std::span<const P> end_points,
                                   std::span<const Face> faces, std::span<const Pair> candidates,
                                   Checked* checked, double separation)
{
    require_host_memory("checking the contacts between frames", candidates.size_bytes());
    std::vector<std::vector<Impact>> parts(candidates.size() / at_once + 1);
    for_each(candidates.size(), checked, [&](std::size_t k, Checked& ours) {
        if (share_a_vertex(faces[candidates[k].a], faces[candidates[k].b]))
            return;
        const MovingQuery query = query_of(points, end_points, faces, candidates[k]);
        if (const auto time = impact_time(query, 1, ours, separation))
            parts[k / at_once].push_back({candidates[k], time->no_later});
    });
    std::vector<Impact> found;
    for (const std::vector<Impact>& part : parts)
        found.insert(found.end(), part.begin(), part.end());
    return found;
}

}  // namespace

std::vector<std::optional<ImpactTime>> impact_times(std::span<const MovingQuery> queries,
                                                    Checked* checked, double separation)
{
    std::vector<std::optional<ImpactTime>> times(queries.size());
    for_each(queries.size(), checked, [&](std::size_t k, Checked& ours) {
        times[k] = impact_time(queries[k], precise, ours, separation);
    });
    return times;
}

std::vector<std::optional<ImpactTime>> impact_times(const Input& input, std::span<const Pair> pairs,
                                                    double separation)
{
    std::vector<MovingQuery> queries;
    for (const Pair pair : pairs)
        queries.push_back(
            input.is_wide() ? query_of(input.wide.points, input.wide.end_points, input.faces, pair)
                            : query_of(input.points, input.end_points, input.faces, pair));
    return impact_times(queries, nullptr, separation);
}

std::vector<std::optional<ImpactTime>> impact_times_by_roots(std::span<const MovingQuery> queries)
{
    std::vector<std::optional<ImpactTime>> times(queries.size());
    for_each(queries.size(), nullptr, [&](std::size_t k, Checked&) {
        times[k] = first_touch(in_whole_numbers(queries[k]), nullptr);
    });
    return times;
}

std::vector<Impact> touching_on_the_way(std::span<const Point> points,
                                        std::span<const Point> end_points,
                                        std::span<const Face> faces,
                                        std::span<const Pair> candidates, Checked* checked,
                                        double separation)
{
    return touching_pairs(points, end_points, faces, candidates, checked, separation);
}

std::vector<Impact> touching_on_the_way(std::span<const WidePoint> points,
                                        std::span<const WidePoint> end_points,
                                        std::span<const Face> faces,
                                        std::span<const Pair> candidates, Checked* checked,
                                        double separation)
{
    return touching_pairs(points, end_points, faces, candidates, checked, separation);
}

}  // namespace bvhbench
