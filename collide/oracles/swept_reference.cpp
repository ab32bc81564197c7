// SPDX-License-Identifier: MIT
//
// Two features of four vertices touch only when these are in one plane, which is when a polynomial of degree 3 in time is zero.
// Whether they touch at such a time follows from signs of polynomials of degree 1 and 2 (`meet`). Interval arithmetic that bisects
// the time decides nearly all pairs; algebraic numbers decide the rest.
#include "collide/oracles/swept_reference.h"

#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/CORE_BigInt.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "geometry/cores.h"
#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

using Interval = CGAL::Interval_nt<false>;
using Whole = CORE::BigInt;
using Truth = CGAL::Uncertain<bool>;
using Sign = CGAL::Uncertain<CGAL::Sign>;

constexpr std::size_t pairs_at_once = 4096;  ///< pairs that a thread takes at once
constexpr int most_halvings = 40;            ///< of the time, in interval arithmetic

/// A polynomial in time of degree 3 or less: the coefficients of 1, t, t^2 and t^3.
template <class Number>
struct Polynomial {
    std::array<Number, 4> of = {Number(0), Number(0), Number(0), Number(0)};

    bool is_zero() const
    {
        return std::ranges::all_of(of, [](const Number& one) { return one == Number(0); });
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
Truth meet_along(const Motion<Number>& all, std::size_t axis, const Sign& normal,
                 const SignOf& sign)
{
    const auto turn = [&](std::size_t a, std::size_t b, std::size_t c) {
        return sign(all.cross(a, b, a, c, axis));
    };
    if (all.of_edges)
        return (turn(0, 1, 2) * turn(0, 1, 3) != CGAL::POSITIVE) &
               (turn(2, 3, 0) * turn(2, 3, 1) != CGAL::POSITIVE);
    return (turn(1, 2, 0) * normal != CGAL::NEGATIVE) & (turn(2, 3, 0) * normal != CGAL::NEGATIVE) &
           (turn(3, 1, 0) * normal != CGAL::NEGATIVE);
}

/// Whether the features meet at a time at which all vertices are in one plane. If that plane is not parallel to some axis, the
/// projection along it tells. Otherwise the face is a segment, or the edges are parallel: one vertex is then on a segment.
template <class Number, class SignOf>
Truth meet(const Motion<Number>& all, const SignOf& sign)
{
    Truth necessary = true, sufficient = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Sign normal = sign(all.normal(axis));
        const Truth along = meet_along(all, axis, normal, sign);
        necessary = necessary & along;
        sufficient = sufficient | ((normal != CGAL::ZERO) & along);
    }
    if (CGAL::certainly_not(necessary))
        return false;
    using Three = std::array<std::size_t, 3>;
    for (const auto& [p, a, b] :
         all.of_edges ? std::array{Three{0, 2, 3}, Three{1, 2, 3}, Three{2, 0, 1}, Three{3, 0, 1}}
                      : std::array{Three{0, 1, 2}, Three{0, 2, 3}, Three{0, 3, 1}, Three{0, 3, 1}})
        if (!CGAL::certainly(sufficient))
            sufficient = sufficient | is_between(all, p, a, b, sign);
    return sufficient;
}

/// Sign of a polynomial over an interval of time, if it is the same throughout.
struct SignDuring {
    Interval time;

    Sign operator()(const Polynomial<Interval>& p) const
    {
        const auto& c = p.of;
        const Interval middle = (time.inf() + time.sup()) / 2;
        const Interval at_middle = c[0] + middle * (c[1] + middle * (c[2] + middle * c[3]));
        const Interval slope = c[1] + time * (Interval(2) * c[2] + time * Interval(3) * c[3]);
        return CGAL::sign(at_middle + slope * (time - middle));
    }
};

/// Whether the features touch from `begin` to `end`, if intervals can tell. Sets `no_later` if they do.
Truth likely_touch(const Motion<Interval>& all, const Polynomial<Interval>& volume, double begin,
                   double end, int halvings, double& no_later)
{
    const SignDuring during{Interval(begin, end)};
    if (CGAL::certainly(during(volume) != CGAL::ZERO))
        return false;
    const Truth meets = meet(all, during);
    if (CGAL::certainly_not(meets))
        return false;
    const Sign at_begin = SignDuring{begin}(volume), at_end = SignDuring{end}(volume);
    if (CGAL::certainly(meets) && CGAL::certainly(at_begin * at_end == CGAL::NEGATIVE)) {
        no_later = end;
        return true;
    }
    if (halvings == 0)
        return Truth::indeterminate();
    const double middle = begin + (end - begin) / 2;
    const Truth first = likely_touch(all, volume, begin, middle, halvings - 1, no_later);
    return CGAL::certainly_not(first)
               ? likely_touch(all, volume, middle, end, halvings - 1, no_later)
               : first;
}

/// Returns a time up to which the features touch, or nothing if they do not.
std::optional<double> exact_touch(const Motion<Whole>& all)
{
    using Kernel = CGAL::Algebraic_kernel_d_1<Whole>;
    static std::mutex one_at_a_time;  // numbers of this type share representations
    const std::lock_guard lock(one_at_a_time);
    const Kernel kernel;
    const auto in_cgal = [](const Polynomial<Whole>& p) {
        return Kernel::Polynomial_1(p.of.begin(), p.of.end());
    };
    // If all vertices stay in one plane, the answer changes only when a sign that `meet` reads does.
    std::vector<Polynomial<Whole>> changes = {all.volume()};
    if (changes.front().is_zero())
        for (std::size_t axis = 0; axis < 3; ++axis) {
            changes.push_back(all.normal(axis));
            for (std::size_t a = 0; a < 4; ++a)
                for (std::size_t b = 0; b < 4; ++b)
                    for (std::size_t c = 0; c < 4; ++c)
                        changes.push_back(a == b ? all.way(a, c, axis)
                                                 : all.cross(a, b, a, c, axis));
        }
    std::set<Kernel::Algebraic_real_1> times = {
        kernel.construct_algebraic_real_1_object()(Whole(0))};
    std::vector<std::pair<Kernel::Algebraic_real_1, Kernel::Multiplicity_type>> roots;
    for (const Polynomial<Whole>& one : changes)
        if (!one.is_zero())
            kernel.solve_1_object()(in_cgal(one), Kernel::Bound(0), Kernel::Bound(1),
                                    std::back_inserter(roots));
    for (const auto& [root, multiplicity] : roots)
        times.insert(root);
    for (const Kernel::Algebraic_real_1& time : times) {
        const auto sign = [&](const Polynomial<Whole>& p) {
            return Sign(kernel.sign_at_1_object()(in_cgal(p), time));
        };
        if (CGAL::certainly(sign(all.volume()) == CGAL::ZERO) && CGAL::certainly(meet(all, sign)))
            return CGAL::to_interval(time).second;
    }
    return std::nullopt;
}

/// Makes a motion of numbers that `number` makes of the 24 coordinates.
template <class Number, class Make>
Motion<Number> motion_of(const std::array<Point, 4>& from, const std::array<Point, 4>& to,
                         bool of_edges, const Make& number)
{
    Motion<Number> all{of_edges, {}};
    for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto coordinate = [&](const Point& p) {
                return number(axis == 0 ? p.x : axis == 1 ? p.y : p.z);
            };
            const Number first = coordinate(from[k]);
            all.at[k][axis].of = {first, coordinate(to[k]) - first, Number(0), Number(0)};
        }
    return all;
}

std::optional<double> touch(const std::array<Point, 4>& from, const std::array<Point, 4>& to,
                            bool of_edges)
{
    {
        const CGAL::Protect_FPU_rounding<true> upwards;
        const auto all =
            motion_of<Interval>(from, to, of_edges, [](float x) { return Interval(x); });
        double no_later = 0;
        const Truth touch = likely_touch(all, all.volume(), 0, 1, most_halvings, no_later);
        if (CGAL::certainly_not(touch))
            return std::nullopt;
        if (CGAL::certainly(touch))
            return no_later;
    }
    int least = 0;  // all coordinates are whole multiples of 2^least
    for (const auto& four : {from, to})
        for (const Point& p : four)
            for (const float x : {p.x, p.y, p.z})
                if (x != 0)
                    least = std::min(least, std::ilogb(x) - 23);
    return exact_touch(motion_of<Whole>(
        from, to, of_edges, [&](float x) { return Whole(std::ldexp(double{x}, -least)); }));
}

}  // namespace

std::vector<Impact> touching_on_the_way(std::span<const Point> points,
                                        std::span<const Point> end_points,
                                        std::span<const Face> faces,
                                        std::span<const Pair> candidates)
{
    require_host_memory("checking the contacts between frames", candidates.size_bytes());
    std::vector<std::vector<Impact>> parts((candidates.size() + pairs_at_once - 1) / pairs_at_once);
    on_all_cores(parts.size(), [&](std::size_t k) {
        const std::size_t first = k * pairs_at_once;
        for (const Pair pair :
             candidates.subspan(first, std::min(pairs_at_once, candidates.size() - first))) {
            const Face a = faces[pair.a], b = faces[pair.b];
            if (share_a_vertex(a, b))
                continue;
            const bool of_edges = b.b == b.c;
            const auto vertices = [&](std::span<const Point> at) {
                return of_edges ? std::array{at[a.a], at[a.b], at[b.a], at[b.b]}
                                : std::array{at[a.a], at[b.a], at[b.b], at[b.c]};
            };
            if (const auto no_later = touch(vertices(points), vertices(end_points), of_edges))
                parts[k].push_back({pair, *no_later});
        }
    });
    std::vector<Impact> found;
    for (const std::vector<Impact>& part : parts)
        found.insert(found.end(), part.begin(), part.end());
    return found;
}

}  // namespace bvhbench
