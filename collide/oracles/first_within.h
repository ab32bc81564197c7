// SPDX-License-Identifier: MIT
//
// When two features of four moving vertices first come within a distance of each other. How far they are apart changes no faster than two
// of their vertices move against each other. If it is large enough at both ends of a piece of time, it is above the distance in between;
// else the piece is halved. At a time it is bounded by intervals: from above by points of the features, from below by directions along
// which they are apart. CGAL's exact numbers decide what these leave open. Needs CGAL.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "collide/oracles/moving_features.h"
#include "collide/oracles/swept_reference.h"

namespace bvhbench {

/// Returns the exact square of the distance at a time.
inline CGAL::Epeck::FT exact_square(const MovingQuery& query, double time)
{
    using Number = CGAL::Epeck::FT;
    std::array<CGAL::Epeck::Point_3, 4> at;
    const auto then = [t = Number(time)](double from, double to) {
        return Number(from) + t * (Number(to) - Number(from));
    };
    for (std::size_t k = 0; k < 4; ++k) {
        const WidePoint p = query.from[k], q = query.to[k];
        at[k] = {then(p.x, q.x), then(p.y, q.y), then(p.z, q.z)};
    }
    std::vector<Number> squares;
    for (const auto& [p, a, b] : vertices_and_edges(query.of_edges))
        squares.push_back(
            at[a] == at[b] ? CGAL::squared_distance(at[p], at[a])
                           : CGAL::squared_distance(at[p], CGAL::Epeck::Segment_3(at[a], at[b])));
    if (query.of_edges && at[0] != at[1] && at[2] != at[3])
        squares.push_back(CGAL::squared_distance(CGAL::Epeck::Segment_3(at[0], at[1]),
                                                 CGAL::Epeck::Segment_3(at[2], at[3])));
    if (!query.of_edges && !CGAL::collinear(at[1], at[2], at[3]))
        squares.push_back(
            CGAL::squared_distance(at[0], CGAL::Epeck::Triangle_3(at[1], at[2], at[3])));
    return *std::ranges::min_element(squares);
}

/// A search for the first time. All members but `query` and `distance` are in units in which no product overflows.
class FirstWithin {
public:
    using Number = CGAL::Interval_nt<false>;

    /// `scaled` is the motion, and `reach` the distance, both times the same power of two.
    FirstWithin(const MovingQuery& query, double distance, const Motion<Number>& scaled,
                Number reach)
        : query_(query), distance_(distance), motion_(scaled), reach_(reach)
    {
        const CGAL::Protect_FPU_rounding<true> upwards;
        for (const auto& [a, b] : between_features()) {
            Number square = 0;
            for (std::size_t axis = 0; axis < 3; ++axis)
                square += CGAL::square(motion_.way(a, b, axis).of[1]);
            fastest_ = std::max(fastest_, CGAL::sqrt(square).sup());
        }
    }

    /// Returns the time to `finest` if the features certainly come within the distance, or may do so: then `no_later` is above 1.
    std::optional<ImpactTime> find(double finest)
    {
        finest_ = finest;
        const double at_start = beyond(0);
        if (at_start < 0)
            return ImpactTime{0, 0};
        const Truth are = during(0, at_start, 1, beyond(1));
        if (CGAL::certainly_not(are))
            return std::nullopt;
        return ImpactTime{*no_sooner_, CGAL::certainly(are) ? no_later_ : uncertain_time};
    }

private:
    using Vec = std::array<Number, 3>;

    /// Vertices of the one feature with those of the other.
    std::vector<std::array<std::size_t, 2>> between_features() const
    {
        if (query_.of_edges)
            return {{0, 2}, {0, 3}, {1, 2}, {1, 3}};
        return {{0, 1}, {0, 2}, {0, 3}};
    }

    static Number dot(const Vec& a, const Vec& b)
    {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }
    static Vec cross(const Vec& a, const Vec& b)
    {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }
    static double middle(Number a) { return (a.inf() + a.sup()) / 2; }

    Vec way(double time, std::size_t a, std::size_t b) const
    {
        Vec way;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto along = motion_.way(a, b, axis);
            way[axis] = along.of[0] + Number(time) * along.of[1];
        }
        return way;
    }

    /// Bounds of the distance at a time: the least that two points of the features have, and the largest along a direction.
    struct Bounds {
        double most = std::numeric_limits<double>::infinity();
        double least = 0;
    };

    /// Takes in two points, one of each feature, that are `to` apart.
    static void take_points(const Vec& to, Bounds& bounds)
    {
        bounds.most = std::min(bounds.most, CGAL::sqrt(dot(to, to)).sup());
    }

    /// Takes in how far the features are apart along a direction, of either sense.
    void take_direction(double time, Vec n, Bounds& bounds) const
    {
        for (Number& one : n)
            one = middle(one);
        const Number length = CGAL::sqrt(dot(n, n));
        if (!(length.inf() > 0))
            return;
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const auto& [a, b] : between_features()) {
            const Number along = dot(n, way(time, a, b)) / length;
            low = std::min(low, along.inf());
            high = std::max(high, along.sup());
        }
        bounds.least = std::max({bounds.least, low, -high});
    }

    /// Takes in the ways from vertices to edges.
    void take_edges(double time, Bounds& bounds) const
    {
        for (const auto& [p, a, b] : vertices_and_edges(query_.of_edges)) {
            const Vec edge = way(time, a, b), from = way(time, a, p);
            const double share = middle(dot(edge, from)) / middle(dot(edge, edge));
            const Number s = share > 0 ? std::min(share, 1.0) : 0.0;  // 0 if it is NaN
            Vec to;
            for (std::size_t axis = 0; axis < 3; ++axis)
                to[axis] = from[axis] - s * edge[axis];
            take_points(to, bounds);
            if (share > 0 && share < 1) {  // what remains of it along the edge is rounding
                const Number rest = middle(dot(to, edge)) / middle(dot(edge, edge));
                for (std::size_t axis = 0; axis < 3; ++axis)
                    to[axis] -= rest * edge[axis];
            }
            take_direction(time, to, bounds);
        }
    }

    /// Takes in the way across the face, or between both edges.
    void take_normal(double time, Bounds& bounds) const
    {
        const bool of_edges = query_.of_edges;
        const Vec u = of_edges ? way(time, 0, 1) : way(time, 1, 2);
        const Vec v = of_edges ? way(time, 2, 3) : way(time, 1, 3);
        const Vec from = of_edges ? way(time, 0, 2) : way(time, 1, 0);
        const Vec normal = cross(u, v);
        take_direction(time, normal, bounds);
        const double area = middle(dot(normal, normal));
        const double s = middle(dot(cross(from, v), normal)) / area;
        const double t = middle(dot(of_edges ? cross(from, u) : cross(u, from), normal)) / area;
        if (!(s >= 0 && t >= 0 && (of_edges ? std::max(s, t) <= 1 : s + t <= 1)))  // or NaN
            return;
        Vec to;
        for (std::size_t axis = 0; axis < 3; ++axis)
            to[axis] =
                from[axis] - Number(s) * u[axis] + (of_edges ? Number(t) : Number(-t)) * v[axis];
        take_points(to, bounds);
    }

    /// Returns by how much more than the distance the features are certainly apart at a time; less than 0 if they are not.
    double beyond(double time)
    {
        --left_;
        {
            const CGAL::Protect_FPU_rounding<true> upwards;
            Bounds bounds;
            take_edges(time, bounds);
            take_normal(time, bounds);
            if (bounds.most <= reach_.inf())
                return -1;
            if (const double more = (Number(bounds.least) - reach_).inf(); more > 0)
                return more;
        }
        const CGAL::Epeck::FT most(distance_);
        return exact_square(query_, time) <= most * most ? -1 : 0;
    }

    /// Whether they come within the distance from `begin`, when they are not, to `end`. Both times have what beyond() returns.
    Truth during(double begin, double at_begin, double end, double at_end)
    {
        constexpr double rounded = 1 + 0x1p-40;  // more than the error of this product and that sum
        if (at_end >= 0 && at_begin + at_end > fastest_ * (end - begin) * rounded)
            return false;
        const double since = no_sooner_.value_or(begin);
        const bool is_short = end - begin <= shortest || left_ <= 0;
        if (at_end < 0 && (end - since <= finest_ || is_short)) {
            no_sooner_ = since;
            no_later_ = end;
            return true;
        }
        if (is_short) {
            no_sooner_ = since;
            return Truth::indeterminate();
        }
        const double half = begin + (end - begin) / 2, at_half = beyond(half);
        const Truth first = during(begin, at_begin, half, at_half);
        return CGAL::certainly(first) ? first : first | during(half, at_half, end, at_end);
    }

    static constexpr double shortest = 0x1p-46;

    const MovingQuery& query_;
    double distance_;
    Motion<Number> motion_;
    Number reach_;
    double fastest_ = 0;  ///< at most, of vertices of the features against each other
    double finest_ = 1;   ///< the most between the bounds of the time
    int left_ = 50'000;   ///< times that are still looked at
    std::optional<double> no_sooner_ = {};
    double no_later_ = uncertain_time;
};

}  // namespace bvhbench
