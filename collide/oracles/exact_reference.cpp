// SPDX-License-Identifier: MIT
#include "collide/oracles/exact_reference.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <variant>

#include "geometry/cores.h"
#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

using Predicates = CGAL::Exact_predicates_inexact_constructions_kernel;
using Constructions = CGAL::Exact_predicates_exact_constructions_kernel;

constexpr std::size_t part_size = 4096;  ///< pairs that a thread takes at once

template <class Kernel>
using Corners3 = std::array<typename Kernel::Point_3, 3>;

template <class Kernel>
Corners3<Kernel> corners(std::span<const Point> points, Face face)
{
    const auto at = [&](uint index) {
        const Point p = points[index];
        return typename Kernel::Point_3(p.x, p.y, p.z);
    };
    return {at(face.a), at(face.b), at(face.c)};
}

/// CGAL requires that triangles have area and segments have length.
template <class Kernel>
using Shape =
    std::variant<typename Kernel::Triangle_3, typename Kernel::Segment_3, typename Kernel::Point_3>;

template <class Kernel>
Shape<Kernel> shape(Corners3<Kernel> at)
{
    if (!CGAL::collinear(at[0], at[1], at[2]))
        return typename Kernel::Triangle_3(at[0], at[1], at[2]);
    std::sort(at.begin(), at.end());  // along the line
    if (at[0] == at[2])
        return at[0];
    return typename Kernel::Segment_3(at[0], at[2]);
}

bool meet(const Shape<Predicates>& a, const Shape<Predicates>& b)
{
    return std::visit(
        [](const auto& first, const auto& second) { return CGAL::do_intersect(first, second); }, a,
        b);
}

/// Returns the distinct indices that both faces name.
std::vector<uint> common(Face a, Face b)
{
    std::vector<uint> shared;
    for (const uint index : std::set<uint>{a.a, a.b, a.c})
        if (index == b.a || index == b.b || index == b.c)
            shared.push_back(index);
    return shared;
}

/// Returns the two indices of a face that remain without one occurrence of `index`.
std::array<uint, 2> others(Face face, uint index)
{
    if (face.a == index)
        return {face.b, face.c};
    if (face.b == index)
        return {face.a, face.c};
    return {face.a, face.b};
}

/// For two triangles with area that share one corner: true if the edge opposite that corner meets the other triangle.
bool far_edge_meets(std::span<const Point> points, Face face, uint corner, Face other)
{
    const auto [p, q] = others(face, corner);
    const Corners3<Predicates> edge = corners<Predicates>(points, {p, q, q});
    const Corners3<Predicates> at = corners<Predicates>(points, other);
    return CGAL::do_intersect(Predicates::Segment_3(edge[0], edge[1]),
                              Predicates::Triangle_3(at[0], at[1], at[2]));
}

/// Returns the third corner of a face that has area and names u and v.
uint third(Face face, uint u, uint v)
{
    return others(face, u)[0] == v ? others(face, u)[1] : others(face, u)[0];
}

/// True if two triangles with area that share the edge u, v are folded onto each other.
bool folded(std::span<const Point> points, Face a, Face b, uint u, uint v)
{
    const Corners3<Predicates> edge = corners<Predicates>(points, {u, v, v});
    const Corners3<Predicates> tips =
        corners<Predicates>(points, {third(a, u, v), third(b, u, v), v});
    return CGAL::coplanar(edge[0], edge[1], tips[0], tips[1]) &&
           CGAL::coplanar_orientation(edge[0], edge[1], tips[0], tips[1]) == CGAL::POSITIVE;
}

/// True if the constructed intersection of a segment with `other` contains more than what lies between `ends`.
template <class Other>
bool more_than(const Constructions::Segment_3& segment, const Other& other,
               const Corners3<Constructions>& ends)
{
    const auto all = CGAL::intersection(segment, other);
    const auto* const line = all ? boost::get<Constructions::Segment_3>(&*all) : nullptr;
    if (line == nullptr || ends[0] == ends[1])
        return line != nullptr;
    return *line != Constructions::Segment_3(ends[0], ends[1]) &&
           *line != Constructions::Segment_3(ends[1], ends[0]);
}

/// For two triangles, at least one without area: true if they have more in common than `shared`. A triangle that is a
/// point is the shared corner itself and has no more.
bool more_in_common(std::span<const Point> points, Face a, Face b, const std::vector<uint>& shared)
{
    using Segment = Constructions::Segment_3;
    const Shape<Constructions> first = shape<Constructions>(corners<Constructions>(points, a));
    const Shape<Constructions> second = shape<Constructions>(corners<Constructions>(points, b));
    if (first.index() == 2 || second.index() == 2)
        return false;
    const auto ends =
        corners<Constructions>(points, {shared.front(), shared.back(), shared.back()});
    const auto* const one = std::get_if<Segment>(&first);
    const auto* const other = std::get_if<Segment>(&second);
    if (one != nullptr && other != nullptr)
        return more_than(*one, *other, ends);
    return one != nullptr ? more_than(*one, std::get<Constructions::Triangle_3>(second), ends)
                          : more_than(*other, std::get<Constructions::Triangle_3>(first), ends);
}

bool contact(std::span<const Point> points, Face a, Face b, bool keep_adjacent)
{
    const Corners3<Predicates> at_a = corners<Predicates>(points, a);
    const Corners3<Predicates> at_b = corners<Predicates>(points, b);
    if (!share_a_vertex(a, b))
        return meet(shape<Predicates>(at_a), shape<Predicates>(at_b));
    if (!keep_adjacent)
        return false;
    const std::vector<uint> shared = common(a, b);
    if (shared.size() == 3)
        return true;
    if (CGAL::collinear(at_a[0], at_a[1], at_a[2]) || CGAL::collinear(at_b[0], at_b[1], at_b[2]))
        return more_in_common(points, a, b, shared);
    if (shared.size() == 2)
        return folded(points, a, b, shared[0], shared[1]);
    return far_edge_meets(points, a, shared[0], b) || far_edge_meets(points, b, shared[0], a);
}

/// CGAL requires that segments have length.
using Edge = std::variant<Constructions::Segment_3, Constructions::Point_3>;

Edge edge_of(const Corners3<Constructions>& at, std::size_t k)
{
    const auto &p = at[k], &q = at[(k + 1) % 3];
    return p == q ? Edge(p) : Edge(Constructions::Segment_3(p, q));
}

/// True if a corner of `a` is as near to the face `b` as the root of `most`.
bool corner_near(const Corners3<Constructions>& a, const Corners3<Constructions>& b,
                 const Constructions::FT& most)
{
    if (CGAL::collinear(b[0], b[1], b[2]))
        return false;  // its edges are all of it
    const Constructions::Triangle_3 face(b[0], b[1], b[2]);
    return std::ranges::any_of(
        a, [&](const auto& p) { return CGAL::squared_distance(p, face) <= most; });
}

/// Returns how far apart the boxes of two triangles are, and their nearest corners, in doubles.
std::pair<double, double> rough_distances(const Corners3<Predicates>& a,
                                          const Corners3<Predicates>& b)
{
    double corners = std::numeric_limits<double>::infinity();
    for (const auto& p : a)
        for (const auto& q : b)
            corners = std::min(corners, CGAL::squared_distance(p, q));
    const CGAL::Bbox_3 box_a = CGAL::bbox_3(a.begin(), a.end()),
                       box_b = CGAL::bbox_3(b.begin(), b.end());
    double boxes = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double gap =
            std::max({0.0, box_a.min(axis) - box_b.max(axis), box_b.min(axis) - box_a.max(axis)});
        boxes += gap * gap;
    }
    return {std::sqrt(boxes), std::sqrt(corners)};
}

bool are_near(std::span<const Point> points, Face a, Face b, double distance)
{
    constexpr double clearly = 1e-6;  // doubles err by less: no square here underflows that matters
    const Corners3<Predicates> rough_a = corners<Predicates>(points, a);
    const Corners3<Predicates> rough_b = corners<Predicates>(points, b);
    const auto [boxes, nearest] = rough_distances(rough_a, rough_b);
    if (boxes > distance * (1 + clearly) || nearest < distance * (1 - clearly))
        return nearest < distance * (1 - clearly);
    if (meet(shape<Predicates>(rough_a), shape<Predicates>(rough_b)))
        return true;
    const auto at_a = corners<Constructions>(points, a), at_b = corners<Constructions>(points, b);
    const Constructions::FT most = Constructions::FT(distance) * Constructions::FT(distance);
    for (std::size_t k = 0; k < 9; ++k)
        if (std::visit(
                [&](const auto& e, const auto& f) { return CGAL::squared_distance(e, f) <= most; },
                edge_of(at_a, k / 3), edge_of(at_b, k % 3)))
            return true;
    return corner_near(at_a, at_b, most) || corner_near(at_b, at_a, most);
}

/// Returns the candidates that `wanted` accepts, in parts on all cores.
PairList chosen_of(std::span<const Pair> candidates, Checked* checked,
                   const std::function<bool(Pair)>& wanted)
{
    require_host_memory("checking the contacts", candidates.size_bytes());
    std::vector<std::vector<Pair>> parts((candidates.size() + part_size - 1) / part_size);
    on_all_cores(parts.size(), [&](std::size_t k) {
        const std::size_t first = k * part_size;
        const auto part = candidates.subspan(first, std::min(part_size, candidates.size() - first));
        for (const Pair pair : part)
            if (wanted(pair))
                parts[k].push_back(pair);
        if (checked != nullptr)
            checked->all += part.size();
    });
    std::vector<Pair> found;
    for (const std::vector<Pair>& part : parts)
        found.insert(found.end(), part.begin(), part.end());
    return PairList(std::move(found));
}

}  // namespace

PairList intersecting_pairs(std::span<const Point> points, std::span<const Face> faces,
                            std::span<const Pair> candidates, bool keep_adjacent, Checked* checked)
{
    return chosen_of(candidates, checked, [&](Pair pair) {
        return contact(points, faces[pair.a], faces[pair.b], keep_adjacent);
    });
}

PairList pairs_within(std::span<const Point> points, std::span<const Face> faces,
                      std::span<const Pair> candidates, bool keep_adjacent, double distance,
                      Checked* checked)
{
    return chosen_of(candidates, checked, [&](Pair pair) {
        const Face a = faces[pair.a], b = faces[pair.b];
        return share_a_vertex(a, b) ? keep_adjacent : are_near(points, a, b, distance);
    });
}

}  // namespace bvhbench
