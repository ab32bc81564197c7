// SPDX-License-Identifier: MIT
#include <cmath>
#include <optional>
#include <random>

#include "helpers.h"

namespace bvhbench {
namespace {

struct Flat {
    double x, y;
};

double area(Flat a, Flat b, Flat c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Returns the scene of one polygon, in the plane x = z, as an OBJ file.
Scene polygon(const std::vector<Flat>& corners)
{
    const Folder folder;
    std::string text, face = "f";
    for (std::size_t k = 0; k < corners.size(); ++k) {
        text += "v " + std::to_string(corners[k].x) + ' ' + std::to_string(corners[k].y) + ' ' +
                std::to_string(corners[k].x) + '\n';
        face += ' ' + std::to_string(k + 1);
    }
    return load_scene(folder.file("a.obj", text + face + "\n"), {});
}

/// Expects triangles that cover a polygon once: they all turn as it does, and are as large together. `with_area` is the number of triangles with area, if it is to be tested.
void expect_covered(const std::vector<Flat>& corners, std::optional<std::size_t> with_area = {})
{
    const Scene scene = polygon(corners);
    ASSERT_EQ(scene.faces.size(), corners.size() - 2);
    double whole = 0, sum = 0;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        whole += area(corners[0], corners[k], corners[k + 1]);
    std::size_t count = 0;
    for (const Face& face : scene.faces) {
        const double part = area(corners[face.a], corners[face.b], corners[face.c]);
        EXPECT_GE(part * (whole > 0 ? 1 : -1), 0);
        count += part != 0 ? 1 : 0;
        sum += part;
    }
    EXPECT_NEAR(sum, whole, 1e-9 * std::fabs(whole));
    EXPECT_EQ(count, with_area.value_or(count));
    EXPECT_EQ(scene.reading.polygons_crossing, 0u);
}

TEST(Polygons, ThatAreConvexStayFans)
{
    const Scene scene = polygon({{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}});
    for (const Face& face : scene.faces)
        EXPECT_EQ(face.a, 0u);
    EXPECT_EQ(scene.reading.polygons_cut, 1u);
    EXPECT_EQ(scene.reading.polygons_concave, 0u);
}

TEST(Polygons, ThatAreNotConvexAreCoveredOnce)
{
    expect_covered({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}, 4);  // an L
    expect_covered({{1, 4}, {1, 1}, {4, 1}, {4, 0}, {0, 0}, {0, 4}}, 4);  // turned
    expect_covered({{2, 1}, {4, 4}, {2, 2}, {0, 4}}, 2);                  // a dart
    expect_covered({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}},
                   8);  // a square with a hole, joined to it by an edge
    expect_covered({{2, 0}, {4, 0}, {4, 2}, {1, 2}, {1, 4}, {0, 4}, {0, 0}},
                   5);  // a straight corner
}

TEST(Polygons, OfManyShapesAreCoveredOnce)
{
    std::mt19937 chance(1);
    for (int trial = 0; trial < 60; ++trial) {
        SCOPED_TRACE(trial);
        std::vector<Flat> star, comb;
        const auto number = [&](unsigned end) { return static_cast<unsigned>(chance() % end); };
        const unsigned corners = 5 + number(40);
        for (unsigned k = 0; k < corners; ++k) {  // around the middle, as far as chance has it
            const double angle = 6.283185307 * k / corners, radius = 1 + number(50);
            star.push_back({std::round(64 * radius * std::cos(angle)) / 64,
                            std::round(64 * radius * std::sin(angle)) / 64});
        }
        for (unsigned k = 0; k < corners; ++k)
            comb.push_back({k / 2.0, k % 2 == 0 ? 1.0 : 2.0 + number(8)});
        comb.push_back({corners / 2.0, 0});
        comb.push_back({-1, 0});
        expect_covered(star);
        expect_covered(comb, comb.size() - 2);
        if (HasFailure())
            return;
    }
}

TEST(Polygons, ThatCrossThemselvesAreTold)
{
    EXPECT_EQ(polygon({{0, 0}, {4, 4}, {4, 0}, {0, 3}}).reading.polygons_crossing, 1u);
}

}  // namespace
}  // namespace bvhbench
