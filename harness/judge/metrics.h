// SPDX-License-Identifier: MIT
//
// How good a tree is, whoever built it: numbers of a spelled-out tree, in double, with compensated sums.
//
// Nothing here recurses: a tree may be as deep as it has leaves. All expect a tree that keeps its promises
// (builders/spell_out.h). What has no value, as any share of a root without area, is left out, never NaN.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "builders/tree.h"
#include "geometry/mesh.h"
#include "harness/choice/sampling.h"

namespace bvhbench {

/// A, the surface area of a box: 0 when it is flat in two directions, not when in one.
template <class Real = double>
Real surface_area(const Aabb& box)
{
    const Real x = static_cast<Real>(box.max_x) - static_cast<Real>(box.min_x);
    const Real y = static_cast<Real>(box.max_y) - static_cast<Real>(box.min_y);
    const Real z = static_cast<Real>(box.max_z) - static_cast<Real>(box.min_z);
    return 2 * (x * y + y * z + z * x);
}

/// A sum of Reals that is as if added in twice the precision, whatever the order: what each addition rounds
/// off is kept apart (Neumaier 1974). Needs no number to be smaller than the sum so far, as Kahan's does.
template <class Real = double>
class CompensatedSum {
public:
    void add(Real value)
    {
        const Real sum = sum_ + value;
        lost_ += std::fabs(sum_) >= std::fabs(value) ? (sum_ - sum) + value : (value - sum) + sum_;
        sum_ = sum;
    }
    Real value() const { return sum_ + lost_; }

private:
    Real sum_ = 0, lost_ = 0;
};

/// A sum over inner nodes, the root and nodes with one child too, and one over leaves, of the area that the
/// metric counts. Any choice of costs follows from them.
struct AreaSums {
    double inner = 0;
    double leaf = 0;

    double cost(const NodeCosts& costs = {}) const
    {
        return costs.inner * inner + costs.triangle * leaf;
    }
};

/// Of A / A_root; SAH := 1/A_root (C_inner sum_inner A + C_tri sum_leaf T A), Aila, Karras, Laine 2013, Eq. (1),
/// with T = 1, is their cost. Nothing if the root has no area.
std::optional<AreaSums> area_sums(const HostTree& tree);

/// Sum over any two children of one node of the area of what both their boxes cover, of A_root.
/// Nothing if the root has no area.
std::optional<double> sibling_overlap(const HostTree& tree);

/// Leaves by their distance from the root: entry d counts those on level d. The last entry is not 0.
std::vector<std::int64_t> leaves_by_depth(const HostTree& tree);

/// What a cell of a result file says about its tree.
struct Quality {
    std::map<std::string, double> counters;
    /// Counters without a value, and why. A weighted sum takes its parts along, unnamed.
    std::map<std::string, std::string> left_out;
    std::vector<std::int64_t> leaves_by_depth;
};

/// All but end-point overlap, which takes longer than a build.
Quality quality_of(const HostTree& tree, const NodeCosts& costs = {});

void add_end_point_overlap(Quality& quality, const HostTree& tree, std::span<const Point> points,
                           std::span<const Face> faces, const NodeCosts& costs = {});

}  // namespace bvhbench
