// SPDX-License-Identifier: MIT
//
// Two features of four vertices touch only when these are in one plane, which is when a polynomial of degree 3 in time is zero.
// Whether they touch at such a time follows from signs of polynomials of degree 1 and 2 (`meet`). Interval arithmetic that bisects
// the time decides nearly all pairs; algebraic numbers decide the rest. If vertices stay in one plane, that polynomial is zero at
// all times, and those signs alone decide; whole numbers tell where intervals cannot tell that it is.
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

#include "collide/oracles/moving_features.h"
#include "geometry/cores.h"
#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

using Interval = CGAL::Interval_nt<false>;
using Whole = CORE::BigInt;

constexpr std::size_t pairs_at_once = 256;  ///< pairs that a thread takes at once
constexpr int most_halvings = 40;           ///< of the time, in interval arithmetic

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

/// Looks for a time at which the features touch, by intervals, from the first on.
struct Search {
    const Motion<Interval>& all;
    const Polynomial<Interval>& volume;
    int undecided;        ///< how many intervals that are not halved further may remain undecided
    double no_later = 0;  ///< if they touch: a time up to which they do

    /// Whether the features touch from `begin` to `end`, if intervals can tell.
    Truth during(double begin, double end, int halvings = most_halvings)
    {
        const SignDuring sign{Interval(begin, end)};
        const Sign side = sign(volume);
        if (CGAL::certainly(side != CGAL::ZERO))
            return false;
        const Truth meets = meet(all, sign);
        if (CGAL::certainly_not(meets))
            return false;
        const Sign at_begin = SignDuring{begin}(volume), at_end = SignDuring{end}(volume);
        const Truth in_one_plane = (side == CGAL::ZERO) | (at_begin * at_end == CGAL::NEGATIVE);
        if (CGAL::certainly(meets & in_one_plane)) {
            no_later = CGAL::certainly(side == CGAL::ZERO) ? begin : end;
            return true;
        }
        if (halvings == 0) {
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

/// Returns the polynomials whose roots are the times at which features that stay in one plane can first touch after time 0: a
/// vertex arrives at an edge from beside it, or, if it stays on the edge's line, at an end.
std::vector<Polynomial<Whole>> arrivals(const Motion<Whole>& all)
{
    std::vector<Polynomial<Whole>> found;
    const auto add_first = [&](const auto& component) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (const Polynomial<Whole> one = component(axis); !one.is_zero()) {
                found.push_back(one);
                return true;
            }
        return false;
    };
    for (const auto& [p, a, b] : vertices_and_edges(all.of_edges))
        if (!add_first([&](std::size_t axis) { return all.cross(a, b, a, p, axis); }))
            for (const std::size_t end : {a, b})
                add_first([&](std::size_t axis) { return all.way(end, p, axis); });
    return found;
}

/// Returns a time up to which the features touch, or nothing if they do not.
std::optional<double> exact_touch(const Motion<Whole>& all)
{
    using Kernel = CGAL::Algebraic_kernel_d_1<Whole>;
    const Kernel kernel;
    const auto in_cgal = [](const Polynomial<Whole>& p) {
        return Kernel::Polynomial_1(p.of.begin(), p.of.end());
    };
    std::vector<Polynomial<Whole>> changes = {all.volume()};
    if (changes.front().is_zero())
        changes = arrivals(all);
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
                            bool of_edges, Checked& checked)
{
    int least = 0;  // all coordinates are whole multiples of 2^least
    for (const auto& four : {from, to})
        for (const Point& p : four)
            for (const float x : {p.x, p.y, p.z})
                if (x != 0)
                    least = std::min(least, std::ilogb(x) - 23);
    const auto in_whole_numbers = [&] {
        return motion_of<Whole>(from, to, of_edges,
                                [&](float x) { return Whole(std::ldexp(double{x}, -least)); });
    };
    static std::mutex one_at_a_time;  // whole numbers share representations
    {
        const CGAL::Protect_FPU_rounding<true> upwards;
        const auto all =
            motion_of<Interval>(from, to, of_edges, [](float x) { return Interval(x); });
        Polynomial<Interval> volume = all.volume();
        Truth in_one_plane = volume.is_zero();
        if (CGAL::is_indeterminate(in_one_plane)) {
            const std::lock_guard lock(one_at_a_time);
            in_one_plane = in_whole_numbers().volume().is_zero();
        }
        if (CGAL::certainly(in_one_plane))
            volume = {};
        // Features in one plane touch from the first time on for a while, before which an interval or two remain undecided.
        Search search{all, volume, CGAL::certainly(in_one_plane) ? 4 : 1};
        const Truth touch = search.during(0, 1);
        if (CGAL::certainly_not(touch))
            return std::nullopt;
        if (CGAL::certainly(touch))
            return search.no_later;
    }
    ++checked.by_roots;
    const std::lock_guard lock(one_at_a_time);
    return exact_touch(in_whole_numbers());
}

}  // namespace

std::vector<Impact> touching_on_the_way(std::span<const Point> points,
                                        std::span<const Point> end_points,
                                        std::span<const Face> faces,
                                        std::span<const Pair> candidates, Checked* checked)
{
    require_host_memory("checking the contacts between frames", candidates.size_bytes());
    std::vector<std::vector<Impact>> parts((candidates.size() + pairs_at_once - 1) / pairs_at_once);
    on_all_cores(parts.size(), [&](std::size_t k) {
        const std::size_t first = k * pairs_at_once;
        const auto part =
            candidates.subspan(first, std::min(pairs_at_once, candidates.size() - first));
        Checked ours{.all = part.size()};
        for (const Pair pair : part) {
            const Face a = faces[pair.a], b = faces[pair.b];
            if (share_a_vertex(a, b))
                continue;
            const bool of_edges = b.b == b.c;
            const auto vertices = [&](std::span<const Point> at) {
                return of_edges ? std::array{at[a.a], at[a.b], at[b.a], at[b.b]}
                                : std::array{at[a.a], at[b.a], at[b.b], at[b.c]};
            };
            if (const auto no_later = touch(vertices(points), vertices(end_points), of_edges, ours))
                parts[k].push_back({pair, *no_later});
        }
        if (checked != nullptr) {
            checked->all += ours.all;
            checked->by_roots += ours.by_roots;
        }
    });
    std::vector<Impact> found;
    for (const std::vector<Impact>& part : parts)
        found.insert(found.end(), part.begin(), part.end());
    return found;
}

}  // namespace bvhbench
