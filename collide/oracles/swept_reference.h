// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "builders/input.h"
#include "collide/oracles/exact_reference.h"
#include "collide/pairs.h"
#include "geometry/moving_query.h"
#include "geometry/triangle.h"

namespace bvhbench {

/// A time after the step. It stands for features of which it is not known whether they come within a distance.
constexpr double uncertain_time = 2;

/// Two features that touch between two frames, or may do so: then no_later is uncertain_time.
struct Impact {
    Pair pair;
    double no_later;  ///< they touch up to this time, from 0 (the first frame) to 1
};

/// Returns the candidates that touch while all vertices move in straight lines from `points` to `end_points`, in the order of the
/// candidates: the oracle of the narrow phase between two frames, independent of its code. Candidates are pairs of a vertex
/// (a, a, a) and any face, the vertex first, or of two edges (a, b, b). Exact for the coordinates as stored, which must be finite;
/// touching counts. Pairs that share a vertex are left out. Counts in `checked`, if given. Uses all host cores. Throws Unavailable
/// without CGAL or with too little host memory.
///
/// With a `separation`, in the unit of the points, features touch that come as near as that. Those of which this is not known are listed
/// too.
std::vector<Impact> touching_on_the_way(std::span<const Point> points,
                                        std::span<const Point> end_points,
                                        std::span<const Face> faces,
                                        std::span<const Pair> candidates,
                                        Checked* checked = nullptr, double separation = 0);

/// As above, of vertices in doubles.
std::vector<Impact> touching_on_the_way(std::span<const WidePoint> points,
                                        std::span<const WidePoint> end_points,
                                        std::span<const Face> faces,
                                        std::span<const Pair> candidates,
                                        Checked* checked = nullptr, double separation = 0);

/// When two features touch first: at a time from no_sooner to no_later, both from 0 to 1; if no_later is uncertain_time, perhaps never.
struct ImpactTime {
    double no_sooner, no_later;
};

/// Returns for each query when its features touch first, nothing if they do not. Touching counts, at times 0 and 1 too. Exact for the
/// coordinates as stored, which must be finite: both bounds are proven, and at most 1e-12 apart. Counts in `checked`, if given. Uses all
/// host cores. Throws Unavailable without CGAL. With a `separation` as above; bounds are farther apart where 50,000 distances do not tell.
std::vector<std::optional<ImpactTime>> impact_times(std::span<const MovingQuery> queries,
                                                    Checked* checked = nullptr,
                                                    double separation = 0);

/// The same of pairs of features that move from the first to the end points of a swept input, or from its doubles if it has them.
std::vector<std::optional<ImpactTime>> impact_times(const Input& input, std::span<const Pair> pairs,
                                                    double separation = 0);

/// As the first by algebraic numbers alone, without the intervals that save most of the time: for tests of the above.
std::vector<std::optional<ImpactTime>> impact_times_by_roots(std::span<const MovingQuery> queries);

/// Returns the pairs that touch, or those of which it is not known.
inline PairList pairs_of(const std::vector<Impact>& impacts, bool are_certain = true)
{
    std::vector<Pair> pairs;
    pairs.reserve(impacts.size());
    for (const Impact& one : impacts)
        if ((one.no_later <= 1) == are_certain)
            pairs.push_back(one.pair);
    return PairList(std::move(pairs));
}

}  // namespace bvhbench
