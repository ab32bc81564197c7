// SPDX-License-Identifier: MIT
//
// The ways between two triangles that can be the shortest: between two corners, from a corner to its foot inside an edge or a face, and
// along the common perpendicular of two edges. What has no such foot or perpendicular, as a triangle without area, is as near as its
// parts are. Of triangles that meet one of these has length 0, unless an edge crosses a face inside both.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace bvhbench {

/// Corners as doubles or as integers; dot, cross_product and less of `Vec` do the arithmetic.
template <class Vec>
using Three = std::array<Vec, 3>;

/// Where a way begins and ends: the shares of a triangle's corners in the point, up to a common factor.
template <class Number>
struct Ends {
    std::array<Number, 3> from, to;
};

/// Returns the shares of a point of the edge from corner i to corner j; of corner i if they are one.
template <class Number>
std::array<Number, 3> shares_of(std::size_t i, const Number& of_i, std::size_t j,
                                const Number& of_j)
{
    std::array<Number, 3> shares{};
    shares[i] = of_i;
    shares[j] = of_j;
    return shares;
}

/// Calls found(over, under, ends) for the ways from each corner of `a` into the edges and the face of `b`, until it returns true. The
/// square of a way's length is over / under, and ends() returns its Ends.
template <class Vec, class Found>
bool any_from_corner(const Three<Vec>& a, const Three<Vec>& b, Found found)
{
    using Number = decltype(Vec::x);
    const Number zero{};
    const Vec normal = cross_product(less(b[1], b[0]), less(b[2], b[0]));
    const Number area = dot(normal, normal);
    for (std::size_t i = 0; i < 3; ++i) {
        std::array<Number, 3> shares;
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t k = (j + 1) % 3;
            const Vec side = less(b[k], b[j]), way = less(a[i], b[j]);
            const Number length = dot(side, side), along = dot(way, side);
            const auto ends = [&] {
                return Ends<Number>{shares_of(i, length, i, length),
                                    shares_of<Number>(j, length - along, k, along)};
            };
            if (!(length <= zero) && zero <= along && along <= length &&
                found(dot(way, way) * length - along * along, length, ends))
                return true;
            shares[(j + 2) % 3] = dot(cross_product(side, way), normal);
        }
        const Number height = dot(less(a[i], b[0]), normal);
        const auto ends = [&] { return Ends<Number>{shares_of(i, area, i, area), shares}; };
        if (!(area <= zero) &&
            std::ranges::all_of(shares, [&](const Number& one) { return zero <= one; }) &&
            found(height * height, area, ends))
            return true;
    }
    return false;
}

/// The same of the ways between two corners and between two edges.
template <class Vec, class Found>
bool any_between_edges(const Three<Vec>& a, const Three<Vec>& b, Found found)
{
    using Number = decltype(Vec::x);
    const Number zero{}, one(1.0);
    for (std::size_t place = 0; place < 9; ++place) {
        const std::size_t i = place / 3, j = place % 3, next_i = (i + 1) % 3, next_j = (j + 1) % 3;
        const Vec way = less(b[j], a[i]);
        const auto corners = [&] {
            return Ends<Number>{shares_of(i, one, i, one), shares_of(j, one, j, one)};
        };
        if (found(dot(way, way), one, corners))
            return true;
        const Vec u = less(a[next_i], a[i]), v = less(b[next_j], b[j]),
                  normal = cross_product(u, v);
        const Number area = dot(normal, normal), height = dot(way, normal);
        const Number s = dot(cross_product(way, v), normal), t = dot(cross_product(way, u), normal);
        const auto ends = [&] {
            return Ends<Number>{shares_of<Number>(i, area - s, next_i, s),
                                shares_of<Number>(j, area - t, next_j, t)};
        };
        if (!(area <= zero) && zero <= s && s <= area && zero <= t && t <= area &&
            found(height * height, area, ends))
            return true;
    }
    return false;
}

/// The same of all ways from `a` to `b`.
template <class Vec, class Found>
bool any_way(const Three<Vec>& a, const Three<Vec>& b, Found found)
{
    const auto back = [&](const auto& over, const auto& under, const auto& ends) {
        return found(over, under, [&] {
            const auto there = ends();
            return decltype(there){there.to, there.from};
        });
    };
    return any_between_edges(a, b, found) || any_from_corner(a, b, found) ||
           any_from_corner(b, a, back);
}

}  // namespace bvhbench
