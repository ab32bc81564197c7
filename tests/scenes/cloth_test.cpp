// SPDX-License-Identifier: MIT
#include "scenes/generate/cloth.h"

#include "helpers.h"
#include "scenes/generate/film.h"
#include "scenes/generate/generators.h"
#include "scenes/generate/random.h"

namespace bvhbench {
namespace {

TEST(NearPairs, AreThoseOfAllPairs)
{
    Random random(3);
    std::vector<Vector> points;
    for (int k = 0; k < 400; ++k)
        points.push_back(2 * vector_of(random.in_ball()));
    NearPairs near;
    for (const double distance : {0.01, 0.2, 0.7, 9.0}) {
        std::set<std::pair<uint, uint>> expected;
        for (uint i = 0; i < points.size(); ++i)
            for (uint j = i + 1; j < points.size(); ++j)
                if (length(points[j] - points[i]) < distance)
                    expected.insert({i, j});
        const auto& found = near.find(points, distance);
        EXPECT_EQ(found.size(), expected.size());  // each pair once
        EXPECT_TRUE((std::set(found.begin(), found.end()) == expected)) << distance;
    }
}

TEST(SheetMesh, HasExactlyItsTrianglesAndNoUnusedPoint)
{
    for (const bool closed : {false, true})
        for (const double aspect : {0.2, 1.0, 5.0})
            for (uint count = 1; count <= 200; ++count) {
                const Mesh mesh = make_sheet(count, aspect, closed);
                EXPECT_EQ(mesh.faces.size(), count);
                std::set<uint> used;
                for (const Face& face : mesh.faces)
                    used.insert({face.a, face.b, face.c});
                EXPECT_EQ(used.size(), mesh.points.size());
                for (const Point& point : mesh.points)
                    EXPECT_TRUE(point.x >= 0 && point.x <= 1 && point.y >= 0 && point.y <= 1);
            }
}

TEST(Shares, AreEvenWhereTheyCanBeAndMakeUpTheWhole)
{
    for (uint total = 7; total < 100; ++total) {
        const std::vector<uint> shares = even_shares(total, 7);
        uint sum = 0;
        for (std::size_t k = 0; k < shares.size(); ++k) {
            sum += shares[k];
            EXPECT_GE(shares[k], 1u);
            if (total >= 14 && k + 1 < shares.size()) {
                EXPECT_EQ(shares[k] % 2, 0u);
            }
        }
        EXPECT_EQ(sum, total);
    }
}

TEST(Cloth, HangsFromItsCornersWithoutBeingStretchedMuch)
{
    Cloth cloth{{}};
    const Sheet sheet = cloth.add(20, 20, false, [](double u, double v) {
        return Vector{u, 1, v};
    });
    for (const uint corner : {sheet.particle(0, 0), sheet.particle(20, 0)})
        cloth.pin(corner);
    const Vector held = cloth.position(sheet.particle(0, 0));
    for (int step = 0; step < 3000; ++step)
        cloth.step({});
    EXPECT_EQ(length(cloth.position(sheet.particle(0, 0)) - held), 0.0);
    const double drop = held.y - cloth.position(sheet.particle(10, 20)).y;
    EXPECT_GT(drop, 0.9);  // the cloth has fallen
    EXPECT_LT(drop, 1.5);
    for (uint j = 0; j < 20; ++j)
        for (uint i = 0; i <= 20; ++i) {
            const double side = length(cloth.position(sheet.particle(i, j + 1)) -
                                       cloth.position(sheet.particle(i, j)));
            EXPECT_LT(side, 1.25 / 20);
        }
}

TEST(Cloth, KeepsItsLayersApart)
{
    Floor floor;
    Cloth cloth{{}};
    std::vector<Sheet> sheets;
    for (const double height : {0.05, 0.1})
        sheets.push_back(cloth.add(12, 12, false, [&](double u, double v) {
            return Vector{0.5 * u, height, 0.5 * v};
        }));
    for (int step = 0; step < 1000; ++step)
        cloth.step({&floor});
    const double cell = 0.5 / 12;
    for (uint j = 0; j <= 12; ++j)
        for (uint i = 0; i <= 12; ++i) {
            EXPECT_GE(cloth.position(sheets[0].particle(i, j)).y, 0.0);
            const double between = length(cloth.position(sheets[1].particle(i, j)) -
                                          cloth.position(sheets[0].particle(i, j)));
            EXPECT_GT(between, 0.6 * cell);
        }
}

TEST(Obstacles, PushTheShortestWayOut)
{
    Ball ball;
    ball.radius = 0.5;
    const auto in_ball = ball.contact({0.25, 0, 0});
    ASSERT_TRUE(in_ball);
    EXPECT_NEAR(in_ball->depth, 0.25 + Obstacle::gap, 1e-12);
    EXPECT_EQ(in_ball->normal.x, 1.0);
    EXPECT_FALSE(ball.contact({0.6, 0, 0}));

    Lathe cone;
    cone.profile = {{1, 0}, {2, 1}};  // opens upwards at 45 degrees
    for (const bool is_wall : {false, true}) {
        cone.is_wall = is_wall;
        const Vector at = {is_wall ? 1.6 : 1.4, 0.5, 0};
        const auto contact = cone.contact(at);
        ASSERT_TRUE(contact);
        const Vector out = at + contact->depth * contact->normal;
        EXPECT_NEAR(std::fabs(out.x - (1 + out.y)) / std::sqrt(2.0), Obstacle::gap, 1e-12);
        EXPECT_FALSE(cone.contact({is_wall ? 1.4 : 1.6, 0.5, 0}));
    }
}

}  // namespace
}  // namespace bvhbench
