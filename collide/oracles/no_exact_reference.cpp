// SPDX-License-Identifier: MIT
#include "collide/oracles/exact_reference.h"
#include "collide/oracles/swept_reference.h"
#include "geometry/error.h"

namespace bvhbench {

PairList intersecting_pairs(std::span<const Point>, std::span<const Face>, std::span<const Pair>,
                            bool, Checked*)
{
    throw Unavailable("this build has no CGAL to tell which triangles intersect");
}

PairList pairs_within(std::span<const Point>, std::span<const Face>, std::span<const Pair>, bool,
                      double, Checked*)
{
    throw Unavailable("this build has no CGAL to tell how far apart triangles are");
}

std::vector<Impact> touching_on_the_way(std::span<const Point>, std::span<const Point>,
                                        std::span<const Face>, std::span<const Pair>, Checked*,
                                        double)
{
    throw Unavailable("this build has no CGAL to tell what touches between two frames");
}

std::vector<Impact> touching_on_the_way(std::span<const WidePoint>, std::span<const WidePoint>,
                                        std::span<const Face> faces,
                                        std::span<const Pair> candidates, Checked* checked, double)
{
    return touching_on_the_way(std::span<const Point>(), {}, faces, candidates, checked);
}

std::vector<std::optional<ImpactTime>> impact_times(std::span<const MovingQuery>, Checked*, double)
{
    throw Unavailable("this build has no CGAL to tell when features touch");
}

std::vector<std::optional<ImpactTime>> impact_times(const Input&, std::span<const Pair>, double)
{
    return impact_times(std::span<const MovingQuery>());
}

std::vector<std::optional<ImpactTime>> impact_times_by_roots(std::span<const MovingQuery> queries)
{
    return impact_times(queries);
}

}  // namespace bvhbench
