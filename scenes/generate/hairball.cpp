// SPDX-License-Identifier: MIT
//
// Modelled on the hairball of the McGuire archive: 2.88 million triangles in long thin tubes that curl inside a sphere. A
// strand is a tube with three sides and `segments` segments of six triangles each:
//
//     root ring   A0 B0 C0      on a small inner sphere
//                 A1 B1 C1      each step turns the direction slightly and advances
//                 ...           a strand near the outer sphere is turned inwards
#include <algorithm>
#include <cmath>

#include "scenes/generate/generators.h"
#include "scenes/generate/random.h"
#include "scenes/generate/vector.h"

namespace bvhbench {
namespace {

constexpr uint segments = 32;
constexpr float root_radius = 0.2f;
constexpr float step = 0.045f;
constexpr float thickness = 0.002f;

Point normalised(Point a)
{
    const float size = length(a);
    return size > 0 ? Point{a.x / size, a.y / size, a.z / size} : Point{1, 0, 0};
}

/// Returns a unit vector perpendicular to `direction`, always the same for the same direction.
Point across(Point direction)
{
    const Point helper = std::fabs(direction.x) < 0.9f ? Point{1, 0, 0} : Point{0, 1, 0};
    return normalised(cross(direction, helper));
}

void add_ring(Mesh& mesh, Point centre, Point direction)
{
    const Point u = across(direction);
    const Point v = cross(direction, u);
    mesh.points.push_back(centre + thickness * u);
    mesh.points.push_back(centre + (-0.5f * thickness) * u + (0.866f * thickness) * v);
    mesh.points.push_back(centre + (-0.5f * thickness) * u + (-0.866f * thickness) * v);
}

void add_segment(Mesh& mesh, uint ring)
{
    for (uint side = 0; side < 3; ++side) {
        const uint a = ring + side, b = ring + (side + 1) % 3;
        mesh.faces.push_back({a, b, b + 3});
        mesh.faces.push_back({a, b + 3, a + 3});
    }
}

void add_strand(Mesh& mesh, Random& random, uint segment_count)
{
    Point direction = normalised(random.in_ball());
    Point centre = root_radius * direction;
    const Point axis = normalised(random.in_ball());   // axis of the strand's curl
    const float curl = 0.15f + 0.35f * random.unit();  // radians per step, approximately
    add_ring(mesh, centre, direction);
    for (uint k = 0; k < segment_count; ++k) {
        direction = direction + curl * cross(axis, direction);
        direction = direction + 0.2f * random.in_ball();
        const float radius = length(centre);
        if (radius > 0.8f)
            direction = direction + (-3.0f * (radius - 0.8f)) * centre;
        direction = normalised(direction);
        const auto ring = static_cast<uint>(mesh.points.size() - 3);
        centre = centre + step * direction;
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
        Random random(strand);  // a strand does not depend on N
        const std::size_t missing = triangles - mesh.faces.size();
        const std::size_t length = std::min<std::size_t>(segments, (missing + 5) / 6);
        add_strand(mesh, random, static_cast<uint>(length));
    }
    mesh.faces.resize(triangles);
    return mesh;
}

}  // namespace bvhbench
