// SPDX-License-Identifier: MIT
//
// After the hairball of the McGuire archive: 2.88 million triangles in long thin tubes that curl inside a
// sphere. A strand is a tube of three sides, `segments` long, six triangles a segment:
//
//     root ring   A0 B0 C0      on a small inner sphere
//                 A1 B1 C1      each step turns a little and moves on
//                 ...           a strand that nears the outer sphere is turned inwards
#include <algorithm>
#include <cmath>

#include "scenes/generate/generators.h"
#include "scenes/generate/random.h"

namespace bvhbench {
namespace {

constexpr uint segments = 32;
constexpr float root_radius = 0.2f;
constexpr float step = 0.045f;
constexpr float thickness = 0.002f;

Point plus(Point a, Point b, float scale)
{
    return {a.x + scale * b.x, a.y + scale * b.y, a.z + scale * b.z};
}
float dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point cross(Point a, Point b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Point normalised(Point a)
{
    const float length = std::sqrt(dot(a, a));
    return length > 0 ? Point{a.x / length, a.y / length, a.z / length} : Point{1, 0, 0};
}

/// Some unit vector across `direction`, the same for the same direction.
Point across(Point direction)
{
    const Point helper = std::fabs(direction.x) < 0.9f ? Point{1, 0, 0} : Point{0, 1, 0};
    return normalised(cross(direction, helper));
}

void add_ring(Mesh& mesh, Point centre, Point direction)
{
    const Point u = across(direction);
    const Point v = cross(direction, u);
    mesh.points.push_back(plus(centre, u, thickness));
    mesh.points.push_back(plus(plus(centre, u, -0.5f * thickness), v, 0.866f * thickness));
    mesh.points.push_back(plus(plus(centre, u, -0.5f * thickness), v, -0.866f * thickness));
}

void add_segment(Mesh& mesh, uint ring)
{
    for (uint side = 0; side < 3; ++side) {
        const uint a = ring + side, b = ring + (side + 1) % 3;
        mesh.faces.push_back({a, b, b + 3});
        mesh.faces.push_back({a, b + 3, a + 3});
    }
}

void add_strand(Mesh& mesh, Random& random, uint length)
{
    Point direction = normalised(random.in_ball());
    Point centre = {root_radius * direction.x, root_radius * direction.y,
                    root_radius * direction.z};
    const Point axis = normalised(random.in_ball());   // the strand's own curl is round this axis
    const float curl = 0.15f + 0.35f * random.unit();  // radians a step, about
    add_ring(mesh, centre, direction);
    for (uint k = 0; k < length; ++k) {
        direction = plus(direction, cross(axis, direction), curl);
        direction = plus(direction, random.in_ball(), 0.2f);
        const float radius = std::sqrt(dot(centre, centre));
        if (radius > 0.8f)
            direction = plus(direction, centre, -3.0f * (radius - 0.8f));
        direction = normalised(direction);
        const auto ring = static_cast<uint>(mesh.points.size() - 3);
        centre = plus(centre, direction, step);
        add_ring(mesh, centre, direction);
        add_segment(mesh, ring);
    }
}

}  // namespace

Mesh make_hairball(uint triangles)
{
    Mesh mesh;
    mesh.faces.reserve(std::size_t{triangles} + 6);
    mesh.points.reserve(std::size_t{triangles} / 2 + triangles / (2 * segments) + 6);
    for (uint strand = 0; mesh.faces.size() < triangles; ++strand) {
        Random random(strand);  // a strand is the same whatever N is
        const std::size_t missing = triangles - mesh.faces.size();
        const std::size_t length = std::min<std::size_t>(segments, (missing + 5) / 6);
        add_strand(mesh, random, static_cast<uint>(length));
    }
    mesh.faces.resize(triangles);
    return mesh;
}

}  // namespace bvhbench
