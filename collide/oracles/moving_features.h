// SPDX-License-Identifier: MIT
//
// Two features of four moving vertices, and whether they touch at a time at which the vertices are in one plane: that follows from
// signs of polynomials in time of degree 1 and 2. Needs CGAL.
#pragma once

#include <CGAL/Uncertain.h>
#include <CGAL/enum.h>

#include <array>
#include <cstddef>
#include <vector>

namespace bvhbench {

using Truth = CGAL::Uncertain<bool>;
using Sign = CGAL::Uncertain<CGAL::Sign>;

/// A polynomial in time of degree 3 or less: the coefficients of 1, t, t^2 and t^3.
template <class Number>
struct Polynomial {
    std::array<Number, 4> of = {Number(0), Number(0), Number(0), Number(0)};

    Truth is_zero() const
    {
        Truth is = true;
        for (const Number& one : of)
            is = is & (one == Number(0));
        return is;
    }
    friend Polynomial operator+(Polynomial a, const Polynomial& b)
    {
        for (std::size_t k = 0; k < 4; ++k)
            a.of[k] = a.of[k] + b.of[k];
        return a;
    }
    friend Polynomial operator-(Polynomial a, const Polynomial& b)
    {
        for (std::size_t k = 0; k < 4; ++k)
            a.of[k] = a.of[k] - b.of[k];
        return a;
    }
    friend Polynomial operator*(const Polynomial& a, const Polynomial& b)
    {
        Polynomial product;
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; i + j < 4; ++j)
                product.of[i + j] = product.of[i + j] + a.of[i] * b.of[j];
        return product;
    }
};

/// Four moving vertices: of edges 0 1 and 2 3, or vertex 0 and the corners 1 2 3 of a face.
template <class Number>
struct Motion {
    using Poly = Polynomial<Number>;
    bool of_edges;
    std::array<std::array<Poly, 3>, 4> at;  ///< coordinates of each vertex

    Poly way(std::size_t from, std::size_t to, std::size_t axis) const
    {
        return at[to][axis] - at[from][axis];
    }
    /// Component of the cross product of the ways from a to b and from c to d.
    Poly cross(std::size_t a, std::size_t b, std::size_t c, std::size_t d, std::size_t axis) const
    {
        const std::size_t y = (axis + 1) % 3, z = (axis + 2) % 3;
        return way(a, b, y) * way(c, d, z) - way(a, b, z) * way(c, d, y);
    }
    /// Component of the normal of the plane that the edges, or the face, span.
    Poly normal(std::size_t axis) const
    {
        return of_edges ? cross(0, 1, 2, 3, axis) : cross(1, 2, 1, 3, axis);
    }
    /// Zero when all vertices are in one plane.
    Poly volume() const
    {
        return way(0, 1, 0) * cross(0, 2, 0, 3, 0) + way(0, 1, 1) * cross(0, 2, 0, 3, 1) +
               way(0, 1, 2) * cross(0, 2, 0, 3, 2);
    }
};

/// Returns each vertex with the ends of each edge of the other feature that it can be on.
inline std::vector<std::array<std::size_t, 3>> vertices_and_edges(bool of_edges)
{
    if (of_edges)
        return {{0, 2, 3}, {1, 2, 3}, {2, 0, 1}, {3, 0, 1}};
    return {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
}

/// Whether vertex p is on the segment from a to b. `sign` returns a polynomial's sign at the time in question.
template <class Number, class SignOf>
Truth is_between(const Motion<Number>& all, std::size_t p, std::size_t a, std::size_t b,
                 const SignOf& sign)
{
    Truth is = true;
    for (std::size_t axis = 0; axis < 3 && !CGAL::certainly_not(is); ++axis)
        is = is & (sign(all.cross(a, b, a, p, axis)) == CGAL::ZERO) &
             (sign(all.way(a, p, axis)) * sign(all.way(b, p, axis)) != CGAL::POSITIVE);
    return is;
}

/// Whether the features meet in the projection along an axis: necessary if they meet, and sufficient if the plane that they
/// span is not parallel to the axis.
template <class Number, class SignOf>
Truth meet_along(const Motion<Number>& all, std::size_t axis, const SignOf& sign)
{
    const auto turn = [&](std::size_t a, std::size_t b, std::size_t c) {
        return sign(all.cross(a, b, a, c, axis));
    };
    if (all.of_edges)
        return (turn(0, 1, 2) * turn(0, 1, 3) != CGAL::POSITIVE) &
               (turn(2, 3, 0) * turn(2, 3, 1) != CGAL::POSITIVE);
    const Sign first = turn(1, 2, 0), second = turn(2, 3, 0), third = turn(3, 1, 0);
    return (first * second != CGAL::NEGATIVE) & (second * third != CGAL::NEGATIVE) &
           (third * first != CGAL::NEGATIVE);
}

/// Whether the features meet at a time at which all vertices are in one plane. If that plane is not parallel to some axis, the
/// projection along it tells. Otherwise the face is a segment, or the edges are parallel: one vertex is then on a segment.
template <class Number, class SignOf>
Truth meet(const Motion<Number>& all, const SignOf& sign)
{
    Truth necessary = true, sufficient = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Sign normal = sign(all.normal(axis));
        const Truth along = meet_along(all, axis, sign);
        necessary = necessary & along;
        sufficient = sufficient | ((normal != CGAL::ZERO) & along);
    }
    if (CGAL::certainly_not(necessary))
        return false;
    for (const auto& [p, a, b] : vertices_and_edges(all.of_edges))
        if (!CGAL::certainly(sufficient))
            sufficient = sufficient | is_between(all, p, a, b, sign);
    return sufficient;
}

}  // namespace bvhbench
