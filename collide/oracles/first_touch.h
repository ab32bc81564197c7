// SPDX-License-Identifier: MIT
//
// When two features of four moving vertices touch first, exactly: at time 0, or at a root of a polynomial. Of degree 3 CGAL's algebraic kernel
// finds it; features that stay in one plane need only degree 2, and square roots. Needs CGAL.
#pragma once

#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Gmpz.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Sqrt_extension.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "collide/oracles/moving_features.h"
#include "collide/oracles/swept_reference.h"

namespace bvhbench {

using Interval = CGAL::Interval_nt<false>;
using Whole = CGAL::Gmpz;  ///< threads share none

/// Sign of a polynomial over an interval of time, if it is the same throughout. Rounding must be protected.
struct SignDuring {
    Interval time;

    template <std::size_t Degree>
    Sign operator()(const Polynomial<Interval, Degree>& p) const
    {
        const Interval middle = (time.inf() + time.sup()) / 2;
        Interval at_middle = p.of[Degree], slope = Interval(int{Degree}) * p.of[Degree];
        for (std::size_t k = Degree; k-- > 0;)
            at_middle = p.of[k] + middle * at_middle;
        for (std::size_t k = Degree; k-- > 1;)
            slope = Interval(static_cast<int>(k)) * p.of[k] + time * slope;
        return CGAL::sign(at_middle + slope * (time - middle));
    }
};

using Kernel = CGAL::Algebraic_kernel_d_1<Whole, CGAL::Gmpq>;

template <std::size_t Degree>
Kernel::Polynomial_1 in_cgal(const Polynomial<Whole, Degree>& p)
{
    return Kernel::Polynomial_1(p.of.begin(), p.of.end());
}

/// A root of a polynomial of any degree, by the algebraic kernel.
struct AnyRoot {
    ImpactTime about;
    Kernel::Algebraic_real_1 exact;

    template <std::size_t Degree>
    Sign sign_of(const Polynomial<Whole, Degree>& p) const
    {
        return CGAL::Sign(Kernel().sign_at_1_object()(in_cgal(p), exact));
    }
};

/// A root of a polynomial of degree 2 or less, without the kernel: `over` divided by `under`, which is positive.
struct SquareRoot {
    using Over = CGAL::Sqrt_extension<Whole, Whole>;
    ImpactTime about;
    Over over;
    Whole under;

    template <std::size_t Degree>
    Sign sign_of(const Polynomial<Whole, Degree>& p) const
    {
        Over value(p.of[Degree]);
        Whole scale = 1;
        for (std::size_t k = Degree; k-- > 0;) {
            scale *= under;
            value = value * over + Over(p.of[k] * scale);
        }
        return CGAL::Sign(CGAL::sign(value));
    }
};

/// Adds the roots from 0 to 1 of a polynomial that is not zero.
template <std::size_t Degree>
void add_roots(const Polynomial<Whole, Degree>& p, std::vector<AnyRoot>& roots)
{
    std::vector<std::pair<Kernel::Algebraic_real_1, Kernel::Multiplicity_type>> found;
    Kernel().solve_1_object()(in_cgal(p), 0, 1, std::back_inserter(found));
    for (const auto& [root, multiplicity] : found) {
        const auto [low, high] = Kernel().approximate_absolute_1_object()(root, 60);
        roots.push_back({{std::max(0.0, CGAL::to_interval(low).first),
                          std::min(1.0, CGAL::to_interval(high).second)},
                         root});
    }
}

/// Adds (first + side * square root of `square`) / under, if it is from 0 to 1. `under` is positive.
inline void add_if_during(const Whole& first, int side, const Whole& square, const Whole& under,
                          std::vector<SquareRoot>& roots)
{
    const SquareRoot::Over over =
        square == 0 ? SquareRoot::Over(first) : SquareRoot::Over(first, Whole(side), square);
    if (CGAL::sign(over) == CGAL::NEGATIVE ||
        CGAL::sign(over - SquareRoot::Over(under)) == CGAL::POSITIVE)
        return;
    // In units of 2^-60: the root of a whole number is from its whole part to 1 more.
    Whole part;
    mpz_sqrt(part.mpz(), (square << 120).mpz());
    const Whole low = (first << 60) + (side < 0 ? -part - 1 : part);
    const double no_sooner = CGAL::to_interval(low / under).first,
                 no_later = CGAL::to_interval((low + 1) / under + 1).second;
    roots.push_back(
        {{std::max(0.0, no_sooner * 0x1p-60), std::min(1.0, no_later * 0x1p-60)}, over, under});
}

template <std::size_t Degree>
void add_roots(const Polynomial<Whole, Degree>& p, std::vector<SquareRoot>& roots)
{
    static_assert(Degree == 1 || Degree == 2);
    const Whole &c = p.of[0], &b = p.of[1], a = Degree == 2 ? p.of[Degree] : Whole(0);
    const Whole square = b * b - 4 * a * c;
    if (a == 0 && b != 0)
        add_if_during(b < 0 ? c : -c, 0, 0, CGAL::abs(b), roots);
    if (a == 0 || square < 0)
        return;
    for (const int side : {-1, 1})
        if (side < 0 || square > 0)
            add_if_during(a < 0 ? b : -b, side, square, 2 * CGAL::abs(a), roots);
}

/// Returns the times at which features that stay in one plane can first touch after time 0: a vertex arrives at an edge from beside it, or,
/// if it stays on the edge's line, at an end.
template <class Root>
std::vector<Root> arrivals(const Areas<Whole>& areas)
{
    std::vector<Root> roots;
    const auto add_first = [&](const auto& components) {
        const auto is_zero = [](const auto& one) { return CGAL::certainly(one.is_zero()); };
        const auto first = std::ranges::find_if_not(components, is_zero);
        if (first != components.end())
            add_roots(*first, roots);
        return first != components.end();
    };
    for (std::size_t k = 0; const auto& [p, a, b] : vertices_and_edges(areas.all.of_edges))
        if (!add_first(areas.turns[k++]))
            for (const std::size_t end : {a, b})
                add_first(areas.all.ways(end, p));
    return roots;
}

/// Returns the first of these times at which the features touch, nothing if there is none.
template <class Root>
std::optional<ImpactTime> first_of(std::vector<Root> roots, const Areas<Whole>& areas,
                                   const Areas<Interval>* near)
{
    std::ranges::sort(roots, {}, [](const Root& one) { return one.about.no_sooner; });
    for (const Root& root : roots) {
        Truth touch = Truth::indeterminate();
        if (near != nullptr) {
            const CGAL::Protect_FPU_rounding<true> upwards;
            touch = meet(*near, SignDuring{{root.about.no_sooner, root.about.no_later}});
        }
        if (CGAL::is_indeterminate(touch))
            touch = meet(areas, [&](const auto& p) { return root.sign_of(p); });
        if (CGAL::certainly(touch))
            return root.about;
    }
    return std::nullopt;
}

/// Returns when the features touch first, nothing if they do not. Where intervals tell signs, `near`, the same motion, saves time, and
/// so do square roots; without it all is left to the algebraic kernel.
inline std::optional<ImpactTime> first_touch(const Motion<Whole>& all, const Areas<Interval>* near)
{
    const auto volume = all.volume();
    const Areas<Whole> areas(all);
    if (CGAL::is_zero(volume.of[0]) &&
        CGAL::certainly(meet(areas, [](const auto& p) { return Sign(CGAL::sign(p.of[0])); })))
        return ImpactTime{0, 0};
    if (CGAL::certainly(volume.is_zero()))
        return near != nullptr ? first_of(arrivals<SquareRoot>(areas), areas, near)
                               : first_of(arrivals<AnyRoot>(areas), areas, near);
    std::vector<AnyRoot> roots;
    add_roots(volume, roots);
    return first_of(std::move(roots), areas, near);
}

}  // namespace bvhbench
