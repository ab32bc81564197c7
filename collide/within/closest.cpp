// SPDX-License-Identifier: MIT
#include "collide/within/closest.h"

#include <cmath>
#include <limits>
#include <optional>

#include "collide/within/distance_filter.h"
#include "collide/within/exact_corners.h"

namespace bvhbench {
namespace {

/// Returns the point at shares of corners, which sum to 1.
Vector point_at(const Three<Vector>& corners, const std::array<double, 3>& shares)
{
    Vector point = {0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k)
        point = less_share(point, -shares[k], corners[k]);
    return point;
}

std::array<double, 3> divided(const std::array<double, 3>& shares)
{
    const double sum = shares[0] + shares[1] + shares[2];
    return {shares[0] / sum, shares[1] / sum, shares[2] / sum};
}

std::array<double, 3> divided(const std::array<Integer, 3>& shares)
{
    const auto [sum, sum_exponent] = (shares[0] + shares[1] + shares[2]).rounded();
    std::array<double, 3> all;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [share, exponent] = shares[k].rounded();
        all[k] = std::ldexp(share / sum, exponent - sum_exponent);
    }
    return all;
}

Three<Vector> from(Point start, const Corners& corners)
{
    return {difference(corners.at[0], start), difference(corners.at[1], start),
            difference(corners.at[2], start)};
}

/// Returns the answer of doubles if the square of the distance is certainly within 2^-33 of theirs.
std::optional<Closest> in_doubles(const Corners& p, const Corners& q)
{
    const Point start = p.at[0];
    const Three<Vector> a = from(start, p), b = from(start, q);
    Way best = {{}, std::numeric_limits<double>::infinity()};
    Closest closest = {};
    any_way(a, b, [&](double, double, const auto& ends) {
        const Ends<double> found = ends();
        const Vector at_a = point_at(a, divided(found.from)), at_b = point_at(b, divided(found.to));
        const Way way = shorter(best, less(at_b, at_a));
        if (way.square < best.square)
            closest = {0, at_a, at_b};
        best = way;
        return false;
    });
    const auto shown = [&, spread = spread_of(p, q)](double factor) {
        return shown_by(best, spread, factor * best.square, factor * best.square);
    };
    if (shown(1 - 0x1p-33) != VERDICT_APART || shown(1 + 0x1p-33) != VERDICT_MEET)
        return std::nullopt;
    const Vector origin = {-double{start.x}, -double{start.y}, -double{start.z}};
    return Closest{std::sqrt(best.square), less(closest.a, origin), less(closest.b, origin)};
}

/// Returns where an edge of `a` crosses the face of `b`, inside both; nothing if none does.
std::optional<Ends<Integer>> crossing(const Three<Exact>& a, const Three<Exact>& b)
{
    const Exact normal = cross_product(less(b[1], b[0]), less(b[2], b[0]));
    for (std::size_t i = 0; i < 3; ++i) {
        const Exact &p = a[i], &q = a[(i + 1) % 3];
        const Integer high = dot(less(p, b[0]), normal), low = dot(less(q, b[0]), normal);
        if (high.sign() * low.sign() >= 0)
            continue;
        Ends<Integer> ends;
        ends.from = shares_of(i, -low, (i + 1) % 3, high);
        int sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            ends.to[k] =
                dot(less(q, p), cross_product(less(b[(k + 1) % 3], p), less(b[(k + 2) % 3], p)));
            sum += ends.to[k].sign();
        }
        if (std::abs(sum) == 3)
            return ends;
    }
    return std::nullopt;
}

Closest in_integers(const Corners& p, const Corners& q)
{
    const ExactCorners exact(p, q);
    const Three<Vector> a = from({0, 0, 0}, p), b = from({0, 0, 0}, q);
    const auto common = [](const Vector& point) { return Closest{0, point, point}; };
    if (const auto ends = crossing(exact.a, exact.b))
        return common(point_at(a, divided(ends->from)));
    if (const auto ends = crossing(exact.b, exact.a))
        return common(point_at(b, divided(ends->from)));
    Integer over, under;  // of the shortest so far
    Ends<Integer> best;
    any_way(exact.a, exact.b, [&](const Integer& top, const Integer& bottom, const auto& ends) {
        if (under.sign() == 0 || !(over * bottom <= top * under)) {
            over = top;
            under = bottom;
            best = ends();
        }
        return over.sign() == 0;
    });
    const Vector at_a = point_at(a, divided(best.from));
    if (over.sign() == 0)
        return common(at_a);
    const auto [top, top_exponent] = over.rounded();
    const auto [bottom, bottom_exponent] = under.rounded();
    const int exponent = top_exponent - bottom_exponent;  // even, as words have 32 bits
    return {std::ldexp(std::sqrt(top / bottom), exponent / 2 + exact.unit), at_a,
            point_at(b, divided(best.to))};
}

}  // namespace

Closest closest_points(const Corners& p, const Corners& q)
{
    for (const Point at : p.at)
        for (const Point other : q.at)
            if (same_place(at, other))
                return {0, {at.x, at.y, at.z}, {at.x, at.y, at.z}};
    const std::optional<Closest> likely = in_doubles(p, q);
    return likely ? *likely : in_integers(p, q);
}

}  // namespace bvhbench
