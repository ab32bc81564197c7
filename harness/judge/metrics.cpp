// SPDX-License-Identifier: MIT
#include "harness/judge/metrics.h"

#include <algorithm>
#include <utility>

#include "harness/judge/end_point_overlap.h"

namespace bvhbench {
namespace {

const HostTree::Node& node_at(const HostTree& tree, int index)
{
    return tree.nodes[static_cast<std::size_t>(index)];
}

bool is_leaf(const HostTree::Node& node) { return node.primitive != HostTree::none; }

double root_area(const HostTree& tree)
{
    return tree.nodes.empty() ? 0 : surface_area(tree.nodes.front().box);
}

/// Returns the intersection of two boxes; its extents are negative if they are apart.
Aabb common(const Aabb& a, const Aabb& b)
{
    return {std::max(a.min_x, b.min_x), std::max(a.min_y, b.min_y), std::max(a.min_z, b.min_z),
            std::min(a.max_x, b.max_x), std::min(a.max_y, b.max_y), std::min(a.max_z, b.max_z)};
}

}  // namespace

std::optional<AreaSums> area_sums(const HostTree& tree)
{
    const double whole = root_area(tree);
    if (!(whole > 0))
        return std::nullopt;
    CompensatedSum<> inner, leaf;
    for (const HostTree::Node& node : tree.nodes)
        (is_leaf(node) ? leaf : inner).add(surface_area(node.box));
    return AreaSums{inner.value() / whole, leaf.value() / whole};
}

std::optional<double> sibling_overlap(const HostTree& tree)
{
    const double whole = root_area(tree);
    if (!(whole > 0))
        return std::nullopt;
    CompensatedSum<> sum;
    for (const HostTree::Node& node : tree.nodes)
        for (std::size_t side = 1; side < HostTree::most_children; ++side)
            for (std::size_t before = 0; before < side && node.child[side] != HostTree::none;
                 ++before) {
                const Aabb& left = node_at(tree, node.child[before]).box;
                const Aabb& right = node_at(tree, node.child[side]).box;
                if (overlap(left, right))
                    sum.add(surface_area(common(left, right)));
            }
    return sum.value() / whole;
}

std::vector<std::int64_t> leaves_by_depth(const HostTree& tree)
{
    std::vector<std::int64_t> counts;
    std::vector<std::pair<int, std::size_t>> stack;  // node and depth
    if (!tree.nodes.empty())
        stack.emplace_back(0, 0);
    while (!stack.empty()) {
        const auto [index, depth] = stack.back();
        stack.pop_back();
        const HostTree::Node& node = node_at(tree, index);
        if (is_leaf(node)) {
            counts.resize(std::max(counts.size(), depth + 1));
            ++counts[depth];
        }
        for (const int child : node.child)
            if (child != HostTree::none)
                stack.emplace_back(child, depth + 1);
    }
    return counts;
}

void count_quality(Cell& cell, const HostTree& tree, const NodeCosts& costs)
{
    if (cell.check.verdict == Check::Verdict::differs) {
        for (const char* counter : {"sah_cost", "sibling_overlap", "depth_max", "epo"})
            cell.left_out[counter] = "the tree is wrong";
        return;
    }
    auto& counters = cell.counters;
    if (const auto sums = area_sums(tree)) {
        counters["sah_inner"] = sums->inner;
        counters["sah_leaf"] = sums->leaf;
        counters["sah_cost"] = sums->cost(costs);
        counters["sibling_overlap"] = sibling_overlap(tree).value();
    } else {
        for (const char* counter : {"sah_cost", "sibling_overlap"})
            cell.left_out[counter] = "the root's box has no area";
    }
    const std::vector<std::int64_t>& depths = cell.leaves_by_depth = leaves_by_depth(tree);
    double leaves = 0, sum = 0;  // integers, exact up to 2^53
    for (std::size_t depth = 0; depth < depths.size(); ++depth) {
        leaves += static_cast<double>(depths[depth]);
        sum += static_cast<double>(depths[depth]) * static_cast<double>(depth);
    }
    if (leaves > 0) {
        counters["depth_max"] = static_cast<double>(depths.size() - 1);
        counters["depth_mean"] = sum / leaves;
    }
}

void count_end_point_overlap(Cell& cell, const HostTree& tree, std::span<const Point> points,
                             std::span<const Face> faces, const NodeCosts& costs)
{
    if (cell.check.verdict == Check::Verdict::differs)
        return;
    if (const auto sums = end_point_overlap(tree, points, faces)) {
        cell.counters["epo_inner"] = sums->inner;
        cell.counters["epo_leaf"] = sums->leaf;
        cell.counters["epo"] = sums->cost(costs);
    } else {
        cell.left_out["epo"] = "no triangle has an area";
    }
}

}  // namespace bvhbench
