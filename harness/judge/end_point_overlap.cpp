// SPDX-License-Identifier: MIT
#include "harness/judge/end_point_overlap.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/cores.h"

namespace bvhbench {
namespace {

using Corner = Polygon::Corner;

/// Returns where the edge meets the plane. The coordinate equals `plane` exactly, so a second cut by it changes nothing.
Corner on_plane(const Corner& a, const Corner& b, std::size_t axis, double plane)
{
    const double t = (plane - a[axis]) / (b[axis] - a[axis]);
    Corner corner;
    for (std::size_t k = 0; k < 3; ++k)
        corner[k] = a[k] + t * (b[k] - a[k]);
    corner[axis] = plane;
    return corner;
}

void add(Polygon& polygon, const Corner& corner)
{
    if (polygon.count < Polygon::most_corners)
        polygon.corners[polygon.count++] = corner;
}

/// Writes to `kept` the part of `polygon` where sign * coordinate >= sign * plane (Sutherland and Hodgman 1974).
void cut(const Polygon& polygon, std::size_t axis, double plane, double sign, Polygon& kept)
{
    kept.count = 0;
    const Corner* from = &polygon.corners[polygon.count - 1];
    bool was_inside = sign * ((*from)[axis] - plane) >= 0;
    for (int i = 0; i < polygon.count; ++i) {
        const Corner* to = &polygon.corners[i];
        const bool is_inside = sign * ((*to)[axis] - plane) >= 0;
        if (is_inside != was_inside)
            add(kept, on_plane(*from, *to, axis, plane));
        if (is_inside)
            add(kept, *to);
        from = to;
        was_inside = is_inside;
    }
}

/// Sets the bounds of a polygon that has corners.
void enclose(Polygon& polygon)
{
    polygon.low = polygon.high = polygon.corners[0];
    for (int i = 1; i < polygon.count; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            polygon.low[k] = std::min(polygon.low[k], polygon.corners[i][k]);
            polygon.high[k] = std::max(polygon.high[k], polygon.corners[i][k]);
        }
}

/// True if the closed box and the polygon's bounding box share a point.
bool overlap(const Aabb& box, const Polygon& polygon)
{
    return box.min_x <= polygon.high[0] && polygon.low[0] <= box.max_x &&
           box.min_y <= polygon.high[1] && polygon.low[1] <= box.max_y &&
           box.min_z <= polygon.high[2] && polygon.low[2] <= box.max_z;
}

/// True if the whole polygon is in the closed box.
bool contains(const Aabb& box, const Polygon& polygon)
{
    return box.min_x <= polygon.low[0] && polygon.high[0] <= box.max_x &&
           box.min_y <= polygon.low[1] && polygon.high[1] <= box.max_y &&
           box.min_z <= polygon.low[2] && polygon.high[2] <= box.max_z;
}

/// The tree in depth-first order: the nodes below a node follow it, up to its `end`.
///
///     0 1 2 3 4 5 6      nodes: 0 is the root with children 1 and 4; 2 and 3 are below 1, whose end is 4
struct DepthFirst {
    struct Node {
        Aabb box;
        std::uint32_t end;
        int triangle;  ///< HostTree::none for inner nodes
    };
    std::vector<Node> nodes;

    explicit DepthFirst(const HostTree& tree)
    {
        nodes.reserve(tree.nodes.size());
        std::vector<int> stack = {0};
        while (!stack.empty()) {
            const int index = stack.back();
            stack.pop_back();
            const auto place = static_cast<std::uint32_t>(nodes.size());
            if (index < 0) {  // all nodes below the node are done
                nodes[static_cast<std::size_t>(~index)].end = place;
                continue;
            }
            const HostTree::Node& node = tree.nodes[static_cast<std::size_t>(index)];
            nodes.push_back({node.box, 0, node.primitive});
            stack.push_back(~static_cast<int>(place));
            for (std::size_t side = HostTree::most_children; side-- > 0;)
                if (node.child[side] != HostTree::none)
                    stack.push_back(node.child[side]);
        }
    }
};

struct Sums {
    CompensatedSum<> surface, inner, leaf;

    void add(const Sums& other)
    {
        surface.add(other.surface.value());
        inner.add(other.inner.value());
        leaf.add(other.leaf.value());
    }
};

/// The part of a triangle in a node's box. It is used for all nodes below that node.
struct Part {
    Polygon polygon;
    double area;
    std::uint32_t end;
};

/// Takes triangles down the tree, one at a time. A child's box is within its parent's, so each box clips what the parent's box
/// left over; most boxes clip nothing.
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
                (node.triangle != HostTree::none ? leaf : inner) += parts_[last_].area;
            }
            ++place;
        }
        sums.surface.add(parts_[0].area);
        sums.inner.add(inner);
        sums.leaf.add(leaf);
    }

private:
    /// Clips the last part to the node. True if an area remains; it becomes the last part.
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
    std::vector<Part> parts_;  ///< [0] is the whole triangle, [last_] its part in the current node
    std::size_t last_ = 0;
};

/// Number of consecutive nodes whose leaves one task sums: neighbours in the tree meet the same nodes.
constexpr std::size_t chunk = 1024;

Sums sums_of(const DepthFirst& tree, std::size_t first, std::span<const Point> points,
             std::span<const Face> faces)
{
    Sums sums;
    Descent descent(tree);
    for (std::size_t i = first; i < std::min(first + chunk, tree.nodes.size()); ++i)
        if (const int triangle = tree.nodes[i].triangle; triangle != HostTree::none)
            descent.add(polygon_of(points, faces[static_cast<std::size_t>(triangle)]),
                        static_cast<std::uint32_t>(i), sums);
    return sums;
}

}  // namespace

Polygon polygon_of(std::span<const Point> points, Face face)
{
    Polygon polygon;
    for (const uint corner : {face.a, face.b, face.c})
        add(polygon, {points[corner].x, points[corner].y, points[corner].z});
    enclose(polygon);
    return polygon;
}

void clip(const Polygon& polygon, const Aabb& box, Polygon& left)
{
    const double low[3] = {box.min_x, box.min_y, box.min_z};
    const double high[3] = {box.max_x, box.max_y, box.max_z};
    Polygon other;
    const Polygon* now = &polygon;
    const auto keep = [&](std::size_t axis, double plane, double sign) {
        Polygon& next = now == &left ? other : left;
        cut(*now, axis, plane, sign, next);
        now = &next;
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (now->count > 0 && polygon.low[axis] < low[axis])
            keep(axis, low[axis], 1);
        if (now->count > 0 && polygon.high[axis] > high[axis])
            keep(axis, high[axis], -1);
    }
    if (now != &left)
        left = *now;
    if (left.count > 0)
        enclose(left);
}

double area(const Polygon& polygon)
{
    // Twice the area as a vector: the sum over the triangles of a fan from the first corner.
    double x = 0, y = 0, z = 0;
    const Corner& o = polygon.corners[0];
    for (int i = 1; i + 1 < polygon.count; ++i) {
        const Corner& a = polygon.corners[i];
        const Corner& b = polygon.corners[i + 1];
        const double u[3] = {a[0] - o[0], a[1] - o[1], a[2] - o[2]};
        const double v[3] = {b[0] - o[0], b[1] - o[1], b[2] - o[2]};
        x += u[1] * v[2] - u[2] * v[1];
        y += u[2] * v[0] - u[0] * v[2];
        z += u[0] * v[1] - u[1] * v[0];
    }
    return 0.5 * std::sqrt(x * x + y * y + z * z);
}

std::optional<AreaSums> end_point_overlap(const HostTree& tree, std::span<const Point> points,
                                          std::span<const Face> faces, unsigned threads)
{
    if (tree.nodes.empty())
        return std::nullopt;
    const DepthFirst flat(tree);
    // Threads take chunks as they become free; the chunks are added in their order, so the sum does not depend on threads.
    std::vector<Sums> chunks((flat.nodes.size() + chunk - 1) / chunk);
    on_all_cores(
        chunks.size(), [&](std::size_t i) { chunks[i] = sums_of(flat, i * chunk, points, faces); },
        threads > 0 ? threads : core_count());

    Sums sums;
    for (const Sums& one : chunks)
        sums.add(one);
    const double surface = sums.surface.value();
    if (!(surface > 0))
        return std::nullopt;
    return AreaSums{sums.inner.value() / surface, sums.leaf.value() / surface};
}

}  // namespace bvhbench
