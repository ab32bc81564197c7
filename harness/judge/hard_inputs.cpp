// SPDX-License-Identifier: MIT
#include "harness/judge/hard_inputs.h"

#include <functional>
#include <random>

namespace bvhbench {
namespace {

/// Random numbers, the same on every machine: the standard fixes the engine's output, not that of distributions.
class Random {
public:
    /// Returns a multiple of 2^-24 in [0, 1).
    float next() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
    Point point() { return {next(), next(), next()}; }

private:
    std::mt19937 engine_{20200511};
};

void add(Mesh& mesh, Point a, Point b, Point c)
{
    const auto first = static_cast<uint>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), {a, b, c});
    mesh.faces.push_back({first, first + 1, first + 2});
}

Point moved(Point p, Point by, float size)
{
    return {p.x + size * by.x, p.y + size * by.y, p.z + size * by.z};
}

/// Returns small triangles at random places in the unit cube, with `change` applied to every vertex.
template <class Change>
Mesh soup(std::size_t triangles, const Change& change)
{
    Random random;
    Mesh mesh;
    for (std::size_t i = 0; i < triangles; ++i) {
        const Point at = random.point();
        const Point a = moved(at, random.point(), 0.05f);
        const Point b = moved(at, random.point(), 0.05f);
        add(mesh, change(at), change(a), change(b));
    }
    return mesh;
}

Point scaled(Point p, float size, float shift) { return moved({shift, shift, shift}, p, size); }

Mesh random_soup(std::size_t n) { return soup(n, std::identity()); }

constexpr HardInput inputs[] = {
    {"random", random_soup},
    {"identical",
     [](std::size_t n) {
         return Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}, std::vector<Face>(n, {0, 1, 2})};
     }},
    {"same-centre",  // boxes of different sizes with exactly one centre: all codes are equal
     [](std::size_t n) {
         Mesh mesh;
         for (std::size_t i = 0; i < n; ++i) {
             const float half = static_cast<float>(i % 64 + 1) * 0.125f;
             add(mesh, {-half, -half, -half}, {half, half, half}, {0, half, 0});
         }
         return mesh;
     }},
    {"flat", [](std::size_t n) { return soup(n, [](Point p) {
                                     return Point{p.x, 3.25f, p.z};
                                 }); }},
    {"points",  // triangles whose corners coincide
     [](std::size_t n) {
         Random random;
         Mesh mesh;
         for (std::size_t i = 0; i < n; ++i) {
             const Point p = random.point();
             add(mesh, p, p, p);
         }
         return mesh;
     }},
    {"outlier",  // all triangles but one share a cell of the Morton grid
     [](std::size_t n) {
         Mesh mesh = random_soup(n);
         for (std::size_t k = mesh.points.size() - 3; k < mesh.points.size(); ++k)
             mesh.points[k] = scaled(mesh.points[k], 1, 1e7f);
         return mesh;
     }},
    {"near-1e6",  // adjacent floats differ by 1/16
     [](std::size_t n) { return soup(n, [](Point p) { return scaled(p, 8, 1e6f); }); }},
    {"denormal",
     [](std::size_t n) { return soup(n, [](Point p) { return scaled(p, 1e-39f, 0); }); }},
    {"huge",  // extents and sums of coordinates come close to the largest float
     [](std::size_t n) { return soup(n, [](Point p) { return scaled(p, 3e38f, -1.5e38f); }); }},
    {"negative-zero",
     [](std::size_t n) {
         return soup(n, [](Point p) {
             return Point{p.x < 0.5f ? -0.0f : 0.0f, p.y < 0.5f ? -0.0f : p.y, -0.0f};
         });
     }},
};

constexpr std::size_t sizes[] = {1, 2, 3, 4, 5, 7, 8, 9, 63, 64, 65, 255, 256, 257, 1000, 4097};

}  // namespace

std::span<const HardInput> hard_inputs() { return inputs; }

std::span<const std::size_t> critical_sizes() { return sizes; }

}  // namespace bvhbench
