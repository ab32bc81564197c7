// SPDX-License-Identifier: MIT
#include <cmath>
#include <map>
#include <numeric>

#include "geometry/hash.h"
#include "helpers.h"
#include "scenes/generate/generators.h"
#include "scenes/motion.h"

namespace bvhbench {
namespace {

/// Makes a scene once for all tests: a moving one takes seconds.
const Scene& made(const std::string& name)
{
    static std::map<std::string, Scene> known;
    const auto [scene, is_new] = known.try_emplace(name);
    if (is_new)
        scene->second = load_scene(name, {});
    return scene->second;
}

std::string name_with(const Generator& generator, std::size_t count, std::size_t frames)
{
    return std::string(generator.name) + ":" + std::to_string(count) +
           (generator.moves ? ":" + std::to_string(frames) : "");
}

Scene generated(const Generator& generator, std::size_t count, std::size_t frames = 1)
{
    return load_scene(name_with(generator, count, frames), {});
}

std::vector<Generator> all_that(bool may_stand)
{
    std::vector<Generator> found;
    for (const Generator& generator : generators())
        if (may_stand || generator.moves)
            found.push_back(generator);
    return found;
}

class EachGenerator : public testing::TestWithParam<Generator> {};
class EachMovingGenerator : public EachGenerator {};
INSTANTIATE_TEST_SUITE_P(Scenes, EachGenerator, testing::ValuesIn(all_that(true)), CaseName());
INSTANTIATE_TEST_SUITE_P(Scenes, EachMovingGenerator, testing::ValuesIn(all_that(false)),
                         CaseName());

TEST_P(EachGenerator, MakesExactlyTheTrianglesAskedForFromItsLeastOn)
{
    const uint least = GetParam().least;
    std::vector<uint> more = {0, 1, 30};
    if (!GetParam().moves) {
        more = {999, 1022, 1023, 1024, 65534, 144045, 412668};
        more.resize(more.size() + 300);
        std::iota(more.end() - 300, more.end(), 0u);
    }
    for (const uint over : more) {
        const Scene scene = generated(GetParam(), least + over);
        EXPECT_EQ(scene.triangle_count(), least + over);
        EXPECT_EQ(scene.objects.size(), least);  // one triangle each
    }
    EXPECT_TRUE(refuses(std::string(GetParam().name) + ":" + std::to_string(least - 1),
                        "BadUsage: scene '"));
}

TEST_P(EachGenerator, MakesTheSameTwiceAndTheSameMotionForAnyNumberOfFrames)
{
    for (const std::size_t count : {1u, 7u, 1000u})
        if (!GetParam().moves) {
            EXPECT_EQ(generated(GetParam(), count).content_hash,
                      generated(GetParam(), count).content_hash);
        }
    const Scene& first = made(name_with(GetParam(), 1000, 4));
    EXPECT_EQ(first.source, "generated");
    if (!GetParam().moves)
        return;
    ASSERT_EQ(first.frames.size(), 4u);
    const Scene two = generated(GetParam(), 1000, 2);
    for (const std::size_t frame : {0, 1})
        EXPECT_TRUE(same_points(two.frames[frame], first.frames[2 * frame + 1])) << frame;
}

TEST_P(EachGenerator, NamesItsObjectsAndRepeatsNoTriangleAndNoCorner)
{
    const Scene& scene = made(name_with(GetParam(), 3000, 5));
    EXPECT_EQ(scene.triangle_count(), 3000u);
    EXPECT_EQ(scene.has_meshes, GetParam().moves);
    std::set<std::string> names;
    for (const SceneObject& object : scene.objects)
        EXPECT_TRUE(names.insert(object.name).second) << object.name;
    std::set<std::set<uint>> seen;
    for (const Face& face : scene.faces) {
        const std::set<uint> corners = {face.a, face.b, face.c};
        EXPECT_EQ(corners.size(), 3u);
        EXPECT_TRUE(seen.insert(corners).second);
    }
}

// Coordinates outside of the stage would mean an unstable simulation. Loading refuses coordinates that are not finite.
TEST_P(EachMovingGenerator, StaysOnItsStageWhateverItsSize)
{
    for (const std::size_t count : {310u, 3000u}) {
        const Scene& scene = made(name_with(GetParam(), count, 5));
        for (const std::vector<Point>& frame : scene.frames) {
            const Aabb box = box_around(frame, scene.faces);
            for (const float low : {box.min_x, box.min_y, box.min_z})
                EXPECT_GT(low, -2.0f);
            for (const float high : {box.max_x, box.max_y, box.max_z})
                EXPECT_LT(high, 2.0f);
        }
    }
}

// No triangle side is much longer than at rest; cloth that explodes or hangs on one particle has longer sides.
TEST_P(EachMovingGenerator, TearsNothing)
{
    const Scene& scene = made(name_with(GetParam(), 3000, 5));
    const auto longest = [&](const std::vector<Point>& points, const SceneObject& object) {
        double most = 0;
        for (uint k = 0; k < object.face_count; ++k) {
            const Face face = scene.faces[object.first_face + k];
            const Point a = points[face.a], b = points[face.b];
            most =
                std::max(most, std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z));
        }
        return most;
    };
    for (const SceneObject& object : scene.objects)
        for (const std::vector<Point>& frame : scene.frames)
            EXPECT_LT(longest(frame, object), 1.4 * longest(scene.frames[0], object) + 0.003)
                << object.name;
}

// Scenes of published results must not change.
TEST(Generators, KeepTheirContent)
{
    const std::pair<const char*, const char*> hashes[] = {
        {"torus:1", "f2ee363c2a832572"},
        {"torus:1000", "d06a6cf64e77fd74"},
        {"sphere:1000", "7bff2d369887edda"},
        {"grid:1000", "f8d5940ddd24c48f"},
        {"hairball:1000", "2413705ac286b7b9"},
        {"soup:1", "0ff47cd18059f735"},
        {"soup:1000", "fc32723256c2a49e"},
        {"refine:soup:100:1000", "6a790c9c7aaff47e"},
        {"cloth-ball:1000:4", "a4b18bfd43b83928"},
        {"cloth-layers:1000:4", "fdd0ce703c806abc"},
        {"cloth-funnel:1000:4", "7d4fd58d9e77ea33"},
        {"cloth-dress:1000:4", "3702aec9b82d18e5"},
        {"n-body:1000:4", "9e039e4cebea8e32"},
        {"worlds:3:60", "58e729a01b90251d"},
        {"worlds:2:300:2", "827e87f18bc41c34"},
    };
    for (const auto& [scene, hash] : hashes)
        EXPECT_EQ(hex(made(scene).content_hash), hash) << scene;
}

TEST(Generators, MakePartsOfTheWhole)
{
    uint made_in_parts = 0;
    for (const Generator& generator : generators()) {
        if (generator.run == nullptr)
            continue;
        ++made_in_parts;
        for (const uint count : {1u, 2u, 7u, 191u, 192u, 193u, 1000u})
            for (const uint parts : {1u, 3u, 8u})
                hold_parts(name_with(generator, count, 1), parts);
    }
    EXPECT_EQ(made_in_parts, 6u);
    EXPECT_FALSE(load_part("sphere:100", 0, 2));
    EXPECT_THROW(load_part("torus:0", 0, 2), BadUsage);
}

TEST(Sphere, IsClosedWhenEvenAndAtLeastSix)
{
    for (const std::size_t count : {6u, 8u, 10u, 100u, 5000u, 65536u}) {
        std::multiset<std::pair<uint, uint>> sides;
        const Scene scene = generated(*generator_called("sphere"), count);
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

TEST(Moving, TakesANumberOfFramesAfterTheTriangles)
{
    EXPECT_EQ(load_scene("n-body:305", {}).frames.size(), 16u);
    EXPECT_EQ(load_scene("n-body:305:1", {}).frames.size(), 1u);
    EXPECT_EQ(load_scene("n-body:305:1000", {}).frames.size(), 1000u);
    EXPECT_EQ(load_scene("n-body:305:7", {}).name, "n-body:305:7");
    for (const std::string bad :
         {"0", "", "-1", "+4", "1001", "4x", " 4", "4:4", "99999999999999999999"})
        EXPECT_TRUE(refuses("n-body:1000:" + bad, "' where a number of frames from 1 to 1000"));
    for (const std::string bad : {"", "x", "-5", ":4", "0:4"})
        EXPECT_TRUE(refuses("n-body:" + bad, "where a triangle count from 1 to"));
    EXPECT_TRUE(refuses("n-body:304", "too few triangles: there must be 305 at least"));
    EXPECT_TRUE(refuses("n-body:268435457", "a triangle count from 1 to 268435456"));
}

TEST(NBody, MovesEveryBodyRigidlyAndBringsThemTogether)
{
    const Scene scene = load_scene("n-body:9150:6", {});
    ASSERT_EQ(scene.objects.size(), n_body_count);
    for (std::size_t frame = 1; frame < scene.frames.size(); ++frame)
        for (const Motion motion : object_motions(scene, frame - 1, frame))
            EXPECT_EQ(motion, Motion::rigid);
    EXPECT_LT(box_around(scene.frames.back(), scene.faces).max_x,
              0.9f * box_around(scene.frames.front(), scene.faces).max_x);
    EXPECT_GT(overlapping_objects(scene, 5), 2u * n_body_count);
}

TEST(ClothBall, LiesOnABallThatTurnsAndOnTheFloor)
{
    const Scene& scene = made("cloth-ball:3000:5");
    ASSERT_EQ(scene.objects[0].name, "cloth");
    const std::size_t ball_begin = scene.faces[scene.objects[1].first_face].a;
    const auto motions = object_motions(scene, 3, 4);
    EXPECT_EQ(motions[0], Motion::deforming);
    EXPECT_EQ(motions[1], Motion::rigid);
    float lowest = 1, highest = 0;
    for (std::size_t k = 0; k < ball_begin; ++k) {
        const Point p = scene.frames.back()[k];
        lowest = std::min(lowest, p.y);
        highest = std::max(highest, p.y);
        EXPECT_GE(p.y, 0.0f);
        EXPECT_GE(std::hypot(p.x, p.y - 0.15, p.z), 0.15);  // outside the ball
    }
    EXPECT_LT(lowest, 0.01f);
    EXPECT_GT(highest, 0.29f);
    EXPECT_LT(highest, 0.33f);
}

TEST(ClothFunnel, PushesTheClothThroughTheNeck)
{
    const Scene& scene = made("cloth-funnel:3000:5");
    const auto below_the_neck = [&](std::size_t frame) {  // fraction of the cloth
        uint count = 0;
        for (uint k = 0; k < scene.objects[0].face_count; ++k)
            count += scene.frames[frame][scene.faces[k].a].y < 0.35f ? 1 : 0;
        return static_cast<double>(count) / scene.objects[0].face_count;
    };
    EXPECT_EQ(below_the_neck(0), 0);
    EXPECT_GT(below_the_neck(4), 0.6);
    const auto motions = object_motions(scene, 2, 3);
    EXPECT_EQ(motions[1], Motion::unchanged);  // funnel
    EXPECT_EQ(motions[2], Motion::rigid);      // ball
    EXPECT_EQ(motions[3], Motion::unchanged);  // floor
}

TEST(TwoSpheres, SinkIntoEachOtherAndTurn)
{
    const Scene scene = load_scene("two-spheres:4000:4", {});
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[0].face_count, scene.objects[1].face_count);
    for (std::size_t frame = 1; frame < scene.frames.size(); ++frame)
        for (const Motion motion : object_motions(scene, frame - 1, frame))
            EXPECT_EQ(motion, Motion::rigid);
    const std::size_t second = scene.faces[scene.objects[1].first_face].a;
    const auto inside = [&](std::size_t frame) {  // fraction of the second sphere's points
        std::size_t count = 0;
        for (std::size_t k = second; k < scene.frames[frame].size(); ++k) {
            const Point p = scene.frames[frame][k];
            count += std::hypot(p.x, p.y, p.z) < 0.5 ? 1 : 0;
        }
        return static_cast<double>(count) /
               static_cast<double>(scene.frames[frame].size() - second);
    };
    EXPECT_LT(inside(0), 0.01);
    EXPECT_NEAR(inside(3), 0.05, 0.01);
}

}  // namespace
}  // namespace bvhbench
