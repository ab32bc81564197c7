// SPDX-License-Identifier: MIT
//
// Two features of four moving vertices, and whether they touch at a time at which the vertices are in one plane: that follows from
// signs of polynomials in time of degree 1 and 2. Needs CGAL.
#pragma once

#include <CGAL/Uncertain.h>
#include <CGAL/enum.h>
#include <CGAL/number_utils.h>

#include <array>
#include <cstddef>
#include <span>

namespace bvhbench {

using Truth = CGAL::Uncertain<bool>;
using Sign = CGAL::Uncertain<CGAL::Sign>;

/// A polynomial in time: the coefficients of 1, t, t^2 and so on.
template <class Number, std::size_t Degree>
struct Polynomial {
    std::array<Number, Degree + 1> of;

    Truth is_zero() const
    {
        Truth is = true;
        for (const Number& one : of)
            is = is & Truth(CGAL::is_zero(one));
        return is;
    }
    friend Polynomial operator+(Polynomial a, const Polynomial& b)
    {
        for (std::size_t k = 0; k <= Degree; ++k)
            a.of[k] += b.of[k];
        return a;
    }
    friend Polynomial operator-(Polynomial a, const Polynomial& b)
    {
        for (std::size_t k = 0; k <= Degree; ++k)
            a.of[k] -= b.of[k];
        return a;
    }
};

template <class Number, std::size_t A, std::size_t B>
Polynomial<Number, A + B> operator*(const Polynomial<Number, A>& a, const Polynomial<Number, B>& b)
{
    Polynomial<Number, A + B> product;
    product.of.fill(Number(0));
    for (std::size_t i = 0; i <= A; ++i)
        for (std::size_t j = 0; j <= B; ++j)
            product.of[i + j] += a.of[i] * b.of[j];
    return product;
}

/// Four moving vertices: of edges 0 1 and 2 3, or vertex 0 and the corners 1 2 3 of a face.
template <class Number>
struct Motion {
    using Way = Polynomial<Number, 1>;
    using Area = Polynomial<Number, 2>;
    bool of_edges;
    std::array<std::array<Way, 3>, 4> at;  ///< coordinates of each vertex

    Way way(std::size_t from, std::size_t to, std::size_t axis) const
    {
        return at[to][axis] - at[from][axis];
    }
    std::array<Way, 3> ways(std::size_t from, std::size_t to) const
    {
        return {way(from, to, 0), way(from, to, 1), way(from, to, 2)};
    }
    /// Component of the cross product of the ways from a to b and from c to d.
    Area cross(std::size_t a, std::size_t b, std::size_t c, std::size_t d, std::size_t axis) const
    {
        const std::size_t y = (axis + 1) % 3, z = (axis + 2) % 3;
        return way(a, b, y) * way(c, d, z) - way(a, b, z) * way(c, d, y);
    }
    /// Component of the normal of the plane that the edges, or the face, span.
    Area normal(std::size_t axis) const
    {
        return of_edges ? cross(0, 1, 2, 3, axis) : cross(1, 2, 1, 3, axis);
    }
    /// Zero when all vertices are in one plane.
    Polynomial<Number, 3> volume() const
    {
        return way(0, 1, 0) * cross(0, 2, 0, 3, 0) + way(0, 1, 1) * cross(0, 2, 0, 3, 1) +
               way(0, 1, 2) * cross(0, 2, 0, 3, 2);
    }
};

/// Returns each vertex with the ends of each edge of the other feature that it can be on.
inline std::span<const std::array<std::size_t, 3>> vertices_and_edges(bool of_edges)
{
    static constexpr std::array<std::array<std::size_t, 3>, 7> all = {
        {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 2, 3}, {1, 2, 3}, {2, 0, 1}, {3, 0, 1}}};
    return of_edges ? std::span(all).subspan(3) : std::span(all).first(3);
}

/// The polynomials whose signs tell whether the features meet.
template <class Number>
struct Areas {
    using Area = typename Motion<Number>::Area;
    Motion<Number> all;
    std::array<std::array<Area, 3>, 4> turns;  ///< of each vertex about the edge that it can be on
    std::array<Area, 3> normal;

    explicit Areas(const Motion<Number>& motion) : all(motion)
    {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            normal[axis] = all.normal(axis);
            for (std::size_t k = 0; const auto& [p, a, b] : vertices_and_edges(all.of_edges))
                turns[k++][axis] = all.cross(a, b, a, p, axis);
        }
    }
};

/// Whether the k-th vertex of `vertices_and_edges` is on the edge. `sign` returns a polynomial's sign at the time in question.
template <class Number, class SignOf>
Truth is_between(const Areas<Number>& areas, std::size_t k, const SignOf& sign)
{
    const auto& [p, a, b] = vertices_and_edges(areas.all.of_edges)[k];
    Truth is = true;
    for (std::size_t axis = 0; axis < 3 && !CGAL::certainly_not(is); ++axis)
        is = is & (sign(areas.turns[k][axis]) == CGAL::ZERO) &
             (sign(areas.all.way(a, p, axis)) * sign(areas.all.way(b, p, axis)) != CGAL::POSITIVE);
    return is;
}

/// Whether the features meet in the projection along an axis: necessary if they meet, and sufficient if the plane that they
/// span is not parallel to the axis.
template <class Number, class SignOf>
Truth meet_along(const Areas<Number>& areas, std::size_t axis, const SignOf& sign)
{
    const auto turn = [&](std::size_t k) { return sign(areas.turns[k][axis]); };
    if (areas.all.of_edges)
        return (turn(0) * turn(1) != CGAL::POSITIVE) & (turn(2) * turn(3) != CGAL::POSITIVE);
    const Sign first = turn(0), second = turn(1), third = turn(2);
    return (first * second != CGAL::NEGATIVE) & (second * third != CGAL::NEGATIVE) &
           (third * first != CGAL::NEGATIVE);
}

/// Whether the features meet at a time at which all vertices are in one plane. If that plane is not parallel to some axis, the
/// projection along it tells. Otherwise the face is a segment, or the edges are parallel: one vertex is then on a segment.
template <class Number, class SignOf>
Truth meet(const Areas<Number>& areas, const SignOf& sign)
{
    Truth is = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Truth along = meet_along(areas, axis, sign);
        if (CGAL::certainly_not(along))
            return false;
        is = is | ((sign(areas.normal[axis]) != CGAL::ZERO) & along);
        if (CGAL::certainly(is))
            return true;
    }
    for (std::size_t k = 0; k < vertices_and_edges(areas.all.of_edges).size(); ++k)
        if (!CGAL::certainly(is))
            is = is | is_between(areas, k, sign);
    return is;
}

}  // namespace bvhbench
