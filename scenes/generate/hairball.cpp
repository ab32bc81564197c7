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
#include <numeric>

#include "scenes/generate/generators.h"
#include "scenes/generate/random.h"
#include "scenes/generate/vector.h"

namespace bvhbench {
namespace {

constexpr uint segments = 32;
constexpr float root_radius = 0.2f;
constexpr float step = 0.045f;
constexpr float hair_thickness = 0.002f;

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
    mesh.points.push_back(centre + hair_thickness * u);
    mesh.points.push_back(centre + (-0.5f * hair_thickness) * u + (0.866f * hair_thickness) * v);
    mesh.points.push_back(centre + (-0.5f * hair_thickness) * u + (-0.866f * hair_thickness) * v);
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

MeshRun hairball_run(uint triangles, FaceRange run)
{
    constexpr uint strand_faces = 6 * segments, strand_points = 3 * (segments + 1);
    const uint strands = triangles / strand_faces, rest = triangles % strand_faces;
    const uint rest_points = rest == 0 ? 0 : 3 * ((rest + 5) / 6 + 1);
    MeshRun made;
    made.mesh_points = std::size_t{strands} * strand_points + rest_points;
    if (run.count == 0)
        return made;
    const uint first = run.first / strand_faces,
               end = (run.first + run.count - 1) / strand_faces + 1;
    Mesh mesh;
    mesh.faces.reserve(std::size_t{end - first} * strand_faces);
    mesh.points.reserve(std::size_t{end - first} * strand_points);
    for (uint strand = first; strand < end; ++strand) {
        Random random(strand);  // a strand does not depend on N
        add_strand(mesh, random, strand < strands ? segments : (rest + 5) / 6);
    }
    const auto faces = mesh.faces.begin() + (run.first - first * strand_faces);
    made.faces.assign(faces, faces + run.count);
    const uint first_point = first * strand_points;
    for (Face& face : made.faces)
        face = {face.a + first_point, face.b + first_point, face.c + first_point};
    made.points = std::move(mesh.points);
    made.vertices.resize(made.points.size());
    std::iota(made.vertices.begin(), made.vertices.end(), first_point);
    return made;
}

Mesh make_hairball(uint triangles)
{
    MeshRun made = hairball_run(triangles, {0, triangles});
    return {std::move(made.points), std::move(made.faces)};
}

}  // namespace bvhbench
