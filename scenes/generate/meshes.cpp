// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "scenes/generate/generators.h"
#include "scenes/generate/random.h"
#include "scenes/generate/vector.h"

namespace bvhbench {
namespace {

/// Returns triangles `run` of a sheet of quads, row by row, with `wide` quads and `stride` vertices per row.
///
///     C---D    A B D and A D C of each quad
///     | / |
///     A---B    the vertex after the last one of a row is the first of that row
std::vector<Face> sheet_faces(FaceRange run, std::size_t wide, std::size_t stride)
{
    std::vector<Face> faces;
    faces.reserve(run.count);
    for (std::size_t k = run.first; k < std::size_t{run.first} + run.count; ++k) {
        const std::size_t quad = k / 2, row = quad / wide * stride, i = quad % wide;
        const auto a = static_cast<uint>(row + i);
        const auto b = static_cast<uint>(row + (i + 1) % stride);
        const auto up = static_cast<uint>(stride);
        faces.push_back(k % 2 == 0 ? Face{a, b, b + up} : Face{a, b + up, a + up});
    }
    return faces;
}

/// Returns triangles of a sheet of w x h quads with vertex (i, j) of 0..w x 0..h at position(i, w, j, h), which is called row by
/// row. The points are those of whole rows.
template <class Position>
MeshRun patch_run(uint triangles, FaceRange run, Position position)
{
    const std::size_t quads = (std::size_t{triangles} + 1) / 2;
    const auto width = static_cast<std::size_t>(std::sqrt(static_cast<double>(quads))) + 1;
    const std::size_t height = (quads + width - 1) / width;
    MeshRun made;
    made.mesh_points = (width + 1) * (height + 1);
    if (run.count == 0)
        return made;
    const std::size_t first_row = run.first / 2 / width;
    const std::size_t last_row = (std::size_t{run.first} + run.count - 1) / 2 / width + 1;
    made.points.reserve((width + 1) * (last_row - first_row + 1));
    for (std::size_t j = first_row; j <= last_row; ++j)
        for (std::size_t i = 0; i <= width; ++i)
            made.points.push_back(position(i, width, j, height));
    made.vertices.resize(made.points.size());
    std::iota(made.vertices.begin(), made.vertices.end(),
              static_cast<uint>(first_row * (width + 1)));
    made.faces = sheet_faces(run, width, width + 1);
    return made;
}

/// Returns the whole mesh that `run` makes runs of.
Mesh whole(MeshRun (*run)(uint triangles, FaceRange run), uint triangles)
{
    MeshRun made = run(triangles, {0, triangles});
    return {std::move(made.points), std::move(made.faces)};
}

/// Returns the point (i / w, j / h, 0).
Point place_in_sheet(std::size_t i, std::size_t w, std::size_t j, std::size_t h)
{
    return {static_cast<float>(i) / static_cast<float>(w),
            static_cast<float>(j) / static_cast<float>(h), 0};
}

/// Removes unused points and orders the others by their first use.
void drop_unused(Mesh& mesh)
{
    constexpr uint none = 0xffffffffu;
    std::vector<uint> place(mesh.points.size(), none);
    std::vector<Point> used;
    for (Face& face : mesh.faces)
        for (uint* const corner : {&face.a, &face.b, &face.c}) {
            if (place[*corner] == none) {
                place[*corner] = static_cast<uint>(used.size());
                used.push_back(mesh.points[*corner]);
            }
            *corner = place[*corner];
        }
    mesh.points = std::move(used);
}

struct Step {
    double angle, sine, cosine, wave;
};

Step step_of(std::size_t part, std::size_t whole)
{
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(part) / static_cast<double>(whole);
    return {angle, std::sin(angle), std::cos(angle), std::sin(7.0 * angle)};
}

/// Returns the smallest k with k^3 >= count: a cube of side 1/k holds one triangle on average.
uint cells_per_side(uint count)
{
    std::uint64_t side = 1;
    while (side * side * side < count)
        ++side;
    return static_cast<uint>(side);
}

}  // namespace

// Computed in doubles, stored as floats: a = 2 pi i / w around the ring, b = 2 pi j / h around the tube,
// r = 0.4 + 0.05 sin(7a) cos(5b), at ((1 + r cos b) cos a, (1 + r cos b) sin a, r sin b).
MeshRun torus_run(uint triangles, FaceRange run)
{
    std::vector<Step> ring;  // the same for every row
    Step tube{};
    double wave = 0;
    return patch_run(triangles, run,
                     [&](std::size_t i, std::size_t w, std::size_t j, std::size_t h) {
                         if (ring.empty())
                             for (std::size_t k = 0; k <= w; ++k)
                                 ring.push_back(step_of(k, w));
                         if (i == 0) {
                             tube = step_of(j, h);
                             wave = std::cos(5.0 * tube.angle);
                         }
                         const Step& a = ring[i];
                         const double r = 0.4 + 0.05 * a.wave * wave;
                         const double reach = 1.0 + r * tube.cosine;
                         return rounded({reach * a.cosine, reach * a.sine, r * tube.sine});
                     });
}

Mesh make_torus(uint triangles) { return whole(torus_run, triangles); }

void append(Mesh& mesh, const Mesh& part)
{
    const auto base = static_cast<uint>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), part.points.begin(), part.points.end());
    for (const Face& face : part.faces)
        mesh.faces.push_back({face.a + base, face.b + base, face.c + base});
}

MeshRun grid_run(uint triangles, FaceRange run)
{
    return patch_run(triangles, run, place_in_sheet);
}

Mesh make_grid(uint triangles) { return whole(grid_run, triangles); }

// The size of triangles shrinks with the cube root of their number, so each overlaps about the same number of others for any N.
MeshRun soup_run(uint triangles, FaceRange run)
{
    const float size = 0.5f / static_cast<float>(cells_per_side(triangles));
    const float room = 1.0f - 2.0f * size;  // keeps corners in the unit cube
    Random random(triangles);
    MeshRun made;
    made.mesh_points = std::size_t{3} * triangles;
    made.points.reserve(std::size_t{3} * run.count);
    made.faces.reserve(run.count);
    for (uint k = 0; k < run.first + run.count; ++k) {  // those before it take random numbers too
        const Point centre = {size + room * random.unit(), size + room * random.unit(),
                              size + room * random.unit()};
        for (int corner = 0; corner < 3; ++corner) {
            const Point at = centre + size * random.in_ball();
            if (k >= run.first)
                made.points.push_back(at);
        }
        if (k >= run.first)
            made.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    made.vertices.resize(made.points.size());
    std::iota(made.vertices.begin(), made.vertices.end(), 3 * run.first);
    return made;
}

Mesh make_soup(uint triangles) { return whole(soup_run, triangles); }

Mesh make_sheet(uint triangles, double aspect, bool closed)
{
    const std::size_t quads = (std::size_t{triangles} + 1) / 2;
    const auto wanted =
        static_cast<std::size_t>(std::sqrt(static_cast<double>(quads) * aspect) + 0.5);
    const std::size_t least = closed ? 3 : 1;  // fewer would repeat a corner
    const std::size_t wide = std::max(least, std::min(wanted, quads));
    const std::size_t high = (quads + wide - 1) / wide;
    const std::size_t stride = closed ? wide : wide + 1;

    Mesh mesh;
    for (std::size_t j = 0; j <= high; ++j)
        for (std::size_t i = 0; i < stride; ++i)
            mesh.points.push_back(place_in_sheet(i, wide, j, high));
    mesh.faces = sheet_faces({0, triangles}, wide, stride);
    drop_unused(mesh);
    return mesh;
}

}  // namespace bvhbench
