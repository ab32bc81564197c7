// SPDX-License-Identifier: MIT
//
// How good a tree is, whoever built it: numbers of a spelled-out tree, in double, with compensated sums.
//
// Nothing here recurses: a tree may be as deep as it has leaves. All expect a tree that keeps its promises
// (builders/spell_out.h). What has no value, as any share of a root without area, is left out, never NaN.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "builders/tree.h"
#include "geometry/mesh.h"

namespace bvhbench {

/// What visiting a node and testing a triangle cost, relative to each other.
/// The paper prints none; with these, of Aila, Karras and Laine 2013, its Table 4 comes out.
struct NodeCosts {
    double inner = 1.2;
    double triangle = 1.0;
};

/// A, the surface area of a box: 0 when it is flat in two directions, not when in one.
double surface_area(const Aabb& box);

/// The two sums of the surface area cost. Any choice of costs follows from them.
struct AreaSums {
    double inner =
        0;  ///< sum over inner nodes, the root and nodes with one child too, of A / A_root
    double leaf = 0;  ///< sum over leaves of A / A_root

    /// SAH := 1/A_root (C_inner sum_inner A + C_tri sum_leaf T A), Aila, Karras, Laine 2013, Eq. (1); T = 1.
    double cost(const NodeCosts& costs = {}) const
    {
        return costs.inner * inner + costs.triangle * leaf;
    }
};

/// Nothing if the root has no area.
std::optional<AreaSums> area_sums(const HostTree& tree);

/// Sum over inner nodes with two children of the area of what both children's boxes cover, of A_root.
/// Nothing if the root has no area.
std::optional<double> sibling_overlap(const HostTree& tree);

/// Leaves by their distance from the root: entry d counts those on level d. The last entry is not 0.
std::vector<std::int64_t> leaves_by_depth(const HostTree& tree);

/// The numbers for a cell that are cheap: sah_cost, sah_inner, sah_leaf, depth_max, depth_mean.
std::map<std::string, double> tree_counters(const HostTree& tree);

/// Those that are not: epo and sibling_overlap.
std::map<std::string, double> overlap_counters(const HostTree& tree, std::span<const Point> points,
                                               std::span<const Face> faces);

}  // namespace bvhbench
