// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/generate/generators.h"
#include "scenes/generate/random.h"
#include "scenes/generate/vector.h"

namespace bvhbench {
namespace {

/// Returns the first `triangles` triangles of a sheet of quads, row by row, with `wide` quads and `stride` vertices per row.
///
///     C---D    A B D and A D C of each quad
///     | / |
///     A---B    the vertex after the last one of a row is the first of that row
std::vector<Face> sheet_faces(uint triangles, std::size_t wide, std::size_t stride)
{
    std::vector<Face> faces;
    faces.reserve(triangles + std::size_t{1});
    for (std::size_t quad = 0; faces.size() < triangles; ++quad) {
        const std::size_t row = quad / wide * stride, i = quad % wide;
        const auto a = static_cast<uint>(row + i);
        const auto b = static_cast<uint>(row + (i + 1) % stride);
        const auto up = static_cast<uint>(stride);
        faces.push_back({a, b, b + up});
        faces.push_back({a, b + up, a + up});
    }
    faces.resize(triangles);
    return faces;
}

/// Returns a sheet of w x h quads with vertex (i, j) of 0..w x 0..h at position(i, w, j, h).
template <class Position>
Mesh make_patch(uint triangles, Position position)
{
    const std::size_t quads = (std::size_t{triangles} + 1) / 2;
    const auto width = static_cast<std::size_t>(std::sqrt(static_cast<double>(quads))) + 1;
    const std::size_t height = (quads + width - 1) / width;
    Mesh mesh;
    mesh.points.reserve((width + 1) * (height + 1));
    for (std::size_t j = 0; j <= height; ++j)
        for (std::size_t i = 0; i <= width; ++i)
            mesh.points.push_back(position(i, width, j, height));
    mesh.faces = sheet_faces(triangles, width, width + 1);
    return mesh;
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
    double angle, sine, cosine;
};

Step step_of(std::size_t part, std::size_t whole)
{
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(part) / static_cast<double>(whole);
    return {angle, std::sin(angle), std::cos(angle)};
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
Mesh make_torus(uint triangles)
{
    std::vector<Step> ring;  // the same for every row
    Step tube{};
    double wave = 0;
    return make_patch(triangles, [&](std::size_t i, std::size_t w, std::size_t j, std::size_t h) {
        if (ring.empty())
            for (std::size_t k = 0; k <= w; ++k)
                ring.push_back(step_of(k, w));
        if (i == 0) {
            tube = step_of(j, h);
            wave = std::cos(5.0 * tube.angle);
        }
        const Step& a = ring[i];
        const double r = 0.4 + 0.05 * std::sin(7.0 * a.angle) * wave;
        const double reach = 1.0 + r * tube.cosine;
        return rounded({reach * a.cosine, reach * a.sine, r * tube.sine});
    });
}

void append(Mesh& mesh, const Mesh& part)
{
    const auto base = static_cast<uint>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), part.points.begin(), part.points.end());
    for (const Face& face : part.faces)
        mesh.faces.push_back({face.a + base, face.b + base, face.c + base});
}

Mesh make_grid(uint triangles) { return make_patch(triangles, place_in_sheet); }

// The size of triangles shrinks with the cube root of their number, so each overlaps about the same number of others for any N.
Mesh make_soup(uint triangles)
{
    const float size = 0.5f / static_cast<float>(cells_per_side(triangles));
    const float room = 1.0f - 2.0f * size;  // keeps corners in the unit cube
    Random random(triangles);
    Mesh mesh;
    mesh.points.reserve(std::size_t{3} * triangles);
    mesh.faces.reserve(triangles);
    for (uint k = 0; k < triangles; ++k) {
        const Point centre = {size + room * random.unit(), size + room * random.unit(),
                              size + room * random.unit()};
        for (int corner = 0; corner < 3; ++corner)
            mesh.points.push_back(centre + size * random.in_ball());
        mesh.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    return mesh;
}

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
    mesh.faces = sheet_faces(triangles, wide, stride);
    drop_unused(mesh);
    return mesh;
}

}  // namespace bvhbench
