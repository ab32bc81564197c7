// SPDX-License-Identifier: MIT
//
// Quality metrics of trees, computed from the spelled-out tree in double, with compensated sums.
//
// No function recurses, because a tree may be as deep as it has leaves. All expect a valid tree (builders/host_tree.h). A metric
// without a value, such as a ratio to a root without area, is left out and never NaN.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "builders/tree.h"
#include "harness/record/record.h"

namespace bvhbench {

/// Returns A, the surface area of a box: 0 if it is flat along two axes, positive if along one.
template <class Real = double>
Real surface_area(const Aabb& box)
{
    const Real x = static_cast<Real>(box.max_x) - static_cast<Real>(box.min_x);
    const Real y = static_cast<Real>(box.max_y) - static_cast<Real>(box.min_y);
    const Real z = static_cast<Real>(box.max_z) - static_cast<Real>(box.min_z);
    return 2 * (x * y + y * z + z * x);
}

/// A sum as accurate as in twice the precision of Real, in any order: the rounding errors of the additions are summed separately
/// (Neumaier 1974). Unlike Kahan's method it allows terms larger than the sum so far.
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

/// Sums of a metric's area over the inner nodes (with the root and nodes with one child) and over the leaves. The metric for any
/// node costs follows from them.
struct AreaSums {
    double inner = 0;
    double leaf = 0;

    double cost(const NodeCosts& costs = {}) const
    {
        return costs.inner * inner + costs.triangle * leaf;
    }
};

/// Returns the sums of A / A_root. Their cost() is SAH := 1/A_root (C_inner sum_inner A + C_tri sum_leaf T A) with T = 1 (Aila,
/// Karras, Laine 2013, Eq. (1)). Returns nothing if the root has no area.
std::optional<AreaSums> area_sums(const HostTree& tree);

/// Returns the surface area of the intersection of sibling boxes, summed over all pairs of siblings, divided by A_root. Returns
/// nothing if the root has no area.
std::optional<double> sibling_overlap(const HostTree& tree);

/// Returns the number of leaves at each depth: entry d counts those on level d. The last entry is not 0.
std::vector<std::int64_t> leaves_by_depth(const HostTree& tree);

/// Writes the counters of a tree's quality to the cell, except the end-point overlap, which takes longer than a build. If the
/// cell's verdict is `differs`, these counters have no value. A missing weighted sum implies that its parts are missing as well.
void count_quality(Cell& cell, const HostTree& tree, const NodeCosts& costs = {});

/// Writes the end-point overlap to the cell, unless its verdict is `differs`.
void count_end_point_overlap(Cell& cell, const HostTree& tree, std::span<const Point> points,
                             std::span<const Face> faces, const NodeCosts& costs = {});

}  // namespace bvhbench
