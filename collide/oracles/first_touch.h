// SPDX-License-Identifier: MIT
//
// When two features of four moving vertices touch first, exactly: at time 0, or at a root of a polynomial of degree 3 or less, which CGAL's
// algebraic kernel finds. Needs CGAL.
#pragma once

#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Gmpz.h>
#include <CGAL/Interval_nt.h>

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

struct Root {
    ImpactTime about;
    Kernel::Algebraic_real_1 exact;
};

template <std::size_t Degree>
Kernel::Polynomial_1 in_cgal(const Polynomial<Whole, Degree>& p)
{
    return Kernel::Polynomial_1(p.of.begin(), p.of.end());
}

/// Adds the roots from 0 to 1 of a polynomial that is not zero.
template <std::size_t Degree>
void add_roots(const Polynomial<Whole, Degree>& p, std::vector<Root>& roots)
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

/// Adds the times at which features that stay in one plane can first touch after time 0: a vertex arrives at an edge from beside it, or,
/// if it stays on the edge's line, at an end.
inline void add_arrivals(const Areas<Whole>& areas, std::vector<Root>& roots)
{
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
}

/// Returns when the features touch first, nothing if they do not. Where intervals tell signs, `near`, the same motion, saves time.
inline std::optional<ImpactTime> first_touch(const Motion<Whole>& all, const Areas<Interval>* near)
{
    const auto volume = all.volume();
    const Areas<Whole> areas(all);
    if (CGAL::is_zero(volume.of[0]) &&
        CGAL::certainly(meet(areas, [](const auto& p) { return Sign(CGAL::sign(p.of[0])); })))
        return ImpactTime{0, 0};
    std::vector<Root> roots;
    if (volume.is_zero())
        add_arrivals(areas, roots);
    else
        add_roots(volume, roots);
    std::ranges::sort(roots, {}, [](const Root& one) { return one.about.no_sooner; });
    for (const Root& root : roots) {
        Truth touch = Truth::indeterminate();
        if (near != nullptr) {
            const CGAL::Protect_FPU_rounding<true> upwards;
            touch = meet(*near, SignDuring{{root.about.no_sooner, root.about.no_later}});
        }
        if (CGAL::is_indeterminate(touch))
            touch = meet(areas, [&](const auto& p) {
                return Sign(Kernel().sign_at_1_object()(in_cgal(p), root.exact));
            });
        if (CGAL::certainly(touch))
            return root.about;
    }
    return std::nullopt;
}

}  // namespace bvhbench
