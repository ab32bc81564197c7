// SPDX-License-Identifier: MIT
#include "harness/judge/end_point_overlap.h"

#include <algorithm>
#include <atomic>
#include <future>
#include <thread>
#include <vector>

#include "harness/judge/clip.h"
#include "harness/judge/compensated_sum.h"

namespace bvhbench {
namespace {

/// The tree as a descent reads it: depth first, so that all below a node follows it, up to `end`.
///
///     0 1 2 3 4 5 6      nodes: 0 is the root, 1 and 4 its children; of 1 below are 2 and 3, its end is 4
struct DepthFirst {
    struct Node {
        Aabb box;
        std::uint32_t end;
        bool is_leaf;
    };
    struct Leaf {
        std::uint32_t node;
        std::uint32_t triangle;
    };
    std::vector<Node> nodes;
    std::vector<Leaf> leaves;  ///< from left to right

    explicit DepthFirst(const HostTree& tree)
    {
        nodes.reserve(tree.nodes.size());
        std::vector<int> stack = {0};
        while (!stack.empty()) {
            const int index = stack.back();
            stack.pop_back();
            const auto place = static_cast<std::uint32_t>(nodes.size());
            if (index < 0) {  // the way back out of a node
                nodes[static_cast<std::size_t>(~index)].end = place;
                continue;
            }
            const HostTree::Node& node = tree.nodes[static_cast<std::size_t>(index)];
            const bool is_leaf = node.primitive != HostTree::none;
            nodes.push_back({node.box, 0, is_leaf});
            if (is_leaf)
                leaves.push_back({place, static_cast<std::uint32_t>(node.primitive)});
            stack.push_back(~static_cast<int>(place));
            for (std::size_t side = HostTree::most_children; side-- > 0;)
                if (node.child[side] != HostTree::none)
                    stack.push_back(node.child[side]);
        }
    }
};

struct Sums {
    CompensatedSum surface, inner, leaf;

    void add(const Sums& other)
    {
        surface.add(other.surface.value());
        inner.add(other.inner.value());
        leaf.add(other.leaf.value());
    }
};

/// What is left of a triangle in some node's box, for all that is below that node.
struct Part {
    Polygon polygon;
    double area;
    std::uint32_t end;
};

/// Takes triangles down the tree one after the other. A child's box is within its parent's, so each box cuts
/// what the one above left, and most cut nothing off.
class Descent {
public:
    explicit Descent(const DepthFirst& tree) : tree_(tree) {}

    void add(const Polygon& triangle, std::uint32_t own_leaf, Sums& sums)
    {
        const auto past = static_cast<std::uint32_t>(tree_.nodes.size());
        parts_.resize(std::max<std::size_t>(parts_.size(), 1));
        parts_[0] = {triangle, area(triangle), past};
        if (!(parts_[0].area > 0))
            return;
        last_ = 0;
        double inner = 0, leaf = 0;
        for (std::uint32_t place = 0; place < past;) {
            const DepthFirst::Node& node = tree_.nodes[place];
            while (parts_[last_].end <= place)
                --last_;
            const bool is_own = place <= own_leaf && own_leaf < node.end;
            if (!is_own) {
                if (!overlap(node.box, parts_[last_].polygon) || !cut(node)) {
                    place = node.end;
                    continue;
                }
                (node.is_leaf ? leaf : inner) += parts_[last_].area;
            }
            ++place;
        }
        sums.surface.add(parts_[0].area);
        sums.inner.add(inner);
        sums.leaf.add(leaf);
    }

private:
    /// Whether some of the surface is in the node. That is then the last part.
    bool cut(const DepthFirst::Node& node)
    {
        if (contains(node.box, parts_[last_].polygon))
            return true;
        parts_.resize(std::max(parts_.size(), last_ + 2));
        Part& part = parts_[last_ + 1];
        clip(parts_[last_].polygon, node.box, part.polygon);
        part.area = area(part.polygon);
        part.end = node.end;
        last_ += part.area > 0 ? 1 : 0;
        return part.area > 0;
    }

    const DepthFirst& tree_;
    std::vector<Part>
        parts_;  ///< [0] is the whole triangle, [last_] what is left in the node at hand
    std::size_t last_ = 0;
};

/// Sums of as many triangles that are neighbours in the tree: they meet the same nodes.
constexpr std::size_t chunk = 512;

Sums sums_of(const DepthFirst& tree, std::size_t first, std::span<const Point> points,
             std::span<const Face> faces)
{
    Sums sums;
    Descent descent(tree);
    const std::size_t last = std::min(first + chunk, tree.leaves.size());
    for (std::size_t i = first; i < last; ++i) {
        const DepthFirst::Leaf& leaf = tree.leaves[i];
        descent.add(polygon_of(points, faces[leaf.triangle]), leaf.node, sums);
    }
    return sums;
}

}  // namespace

std::optional<AreaSums> end_point_overlap(const HostTree& tree, std::span<const Point> points,
                                          std::span<const Face> faces, unsigned threads)
{
    if (tree.nodes.empty())
        return std::nullopt;
    const DepthFirst flat(tree);
    // Whoever is free takes the next chunk; chunks are added up in their order.
    std::vector<Sums> chunks((flat.leaves.size() + chunk - 1) / chunk);
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i; (i = next++) < chunks.size();)
            chunks[i] = sums_of(flat, i * chunk, points, faces);
    };
    std::vector<std::future<void>> others;
    const unsigned wanted = threads > 0 ? threads : std::thread::hardware_concurrency();
    for (std::size_t i = 1; i < std::min<std::size_t>(wanted, chunks.size()); ++i)
        others.push_back(std::async(std::launch::async, work));
    work();
    for (std::future<void>& other : others)
        other.get();

    Sums sums;
    for (const Sums& one : chunks)
        sums.add(one);
    const double surface = sums.surface.value();
    if (!(surface > 0))
        return std::nullopt;
    return AreaSums{sums.inner.value() / surface, sums.leaf.value() / surface};
}

}  // namespace bvhbench
