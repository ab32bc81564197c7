// SPDX-License-Identifier: MIT
#include <set>

#include "geometry/hash.h"
#include "helpers.h"
#include "scenes/generate/catalog.h"

namespace bvhbench {
namespace {

Scene generated(std::string_view generator, std::size_t count)
{
    return load_scene(std::string(generator) + ":" + std::to_string(count), {});
}

class EachGenerator : public testing::TestWithParam<Generator> {};

TEST_P(EachGenerator, MakesExactlyTheTrianglesAskedFor)
{
    for (std::size_t count = 1; count <= 300; ++count)
        EXPECT_EQ(generated(GetParam().name, count).triangle_count(), count);
    for (const std::size_t count : {1000u, 1023u, 1024u, 1025u, 65535u, 144046u, 412669u})
        EXPECT_EQ(generated(GetParam().name, count).triangle_count(), count);
}

TEST_P(EachGenerator, MakesTheSameTwice)
{
    for (const std::size_t count : {1u, 7u, 1000u}) {
        const Scene first = generated(GetParam().name, count);
        EXPECT_EQ(first.content_hash, generated(GetParam().name, count).content_hash);
        EXPECT_NE(first.content_hash, generated(GetParam().name, count + 1).content_hash);
        EXPECT_EQ(first.source, "generated");
        EXPECT_EQ(first.objects.size(), 1u);
    }
}

TEST_P(EachGenerator, RepeatsNoTriangleAndNoCorner)
{
    const Scene scene = generated(GetParam().name, 5000);
    std::set<std::set<uint>> seen;
    for (const Face& face : scene.faces) {
        const std::set<uint> corners = {face.a, face.b, face.c};
        EXPECT_EQ(corners.size(), 3u);
        EXPECT_TRUE(seen.insert(corners).second);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, EachGenerator,
                         testing::ValuesIn(generators().begin(), generators().end()),
                         [](const auto& generator) { return std::string(generator.param.name); });

// What a published result was built over must stay what it was.
TEST(Generators, KeepTheirContent)
{
    const std::pair<const char*, const char*> hashes[] = {
        {"torus:1", "f2ee363c2a832572"},       {"torus:1000", "d06a6cf64e77fd74"},
        {"sphere:1000", "7bff2d369887edda"},   {"grid:1000", "f8d5940ddd24c48f"},
        {"hairball:1000", "2413705ac286b7b9"}, {"soup:1", "0ff47cd18059f735"},
        {"soup:1000", "fc32723256c2a49e"},     {"refine:soup:100:1000", "6a790c9c7aaff47e"},
    };
    for (const auto& [scene, hash] : hashes)
        EXPECT_EQ(hex(load_scene(scene, {}).content_hash), hash) << scene;
}

TEST(Torus, HasTheVerticesOfItsFormula)
{
    const Scene scene = load_scene("torus:7", {});  // 4 quads, 3 columns, 2 rows
    ASSERT_EQ(scene.frames[0].size(), 12u);
    EXPECT_FLOAT_EQ(scene.frames[0][0].x, 1.4f);
    EXPECT_EQ(scene.frames[0][0].z, 0.0f);
    EXPECT_FLOAT_EQ(scene.frames[0][4].x, 0.6f);  // half round the tube
    const Face second = scene.faces[1];
    EXPECT_EQ(second.a, 0u);
    EXPECT_EQ(second.b, 5u);
    EXPECT_EQ(second.c, 4u);
}

TEST(Sphere, IsClosedWhenEvenAndAtLeastSix)
{
    for (const std::size_t count : {6u, 8u, 10u, 100u, 5000u, 65536u}) {
        std::multiset<std::pair<uint, uint>> sides;
        const Scene scene = generated("sphere", count);
        for (const Face& face : scene.faces)
            for (const auto& side :
                 {std::pair{face.a, face.b}, std::pair{face.b, face.c}, std::pair{face.c, face.a}})
                sides.insert(side);
        for (const auto& [a, b] : sides) {
            ASSERT_EQ(sides.count({a, b}), 1u) << count;
            ASSERT_EQ(sides.count({b, a}), 1u) << count;
        }
    }
}

TEST(Soup, StaysInTheUnitCube)
{
    for (const std::size_t count : {1u, 1000u}) {
        const Scene scene = generated("soup", count);
        for (const Point& point : scene.frames[0])
            for (const float coordinate : {point.x, point.y, point.z}) {
                EXPECT_GE(coordinate, 0.0f);
                EXPECT_LE(coordinate, 1.0f);
            }
    }
}

TEST(Hairball, StaysNearTheUnitBall)
{
    const Scene scene = generated("hairball", 100000);
    for (const Point& point : scene.frames[0])
        EXPECT_LT(point.x * point.x + point.y * point.y + point.z * point.z, 1.2f);
}

}  // namespace
}  // namespace bvhbench
