// SPDX-License-Identifier: MIT
//
// Colliders of libraries, which keep up with the frames themselves: each is reserved once, and sees points move.
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "baselines/colliders.h"
#include "geometry/hash.h"
#include "tests/collide/collider_testing.h"
#include "tests/collide/data_set.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

constexpr Among all_kinds[] = {Among::all, Among::between_objects, Among::within_objects};

/// Through a pointer: compilers warn that a function, where it is one, is never null.
bool is_built(MakeCollider make) { return make != nullptr; }

Input uploaded(std::span<const Point> points, std::span<const Face> faces,
               std::span<const FaceRange> objects = {})
{
    return upload(session().device(), session().queue(), points, faces, objects);
}

/// What one query finds, in order; each pair once.
PairList found_by(Collider& collider, const Input& input)
{
    EXPECT_EQ(find_pairs(collider, nullptr, input, session().queue()), 1);
    const PairList found(collider.pairs(session().queue()));
    EXPECT_EQ(found.surplus(), 0u);
    EXPECT_EQ(collider.counts(session().queue()).pairs, found.size());
    session().queue().finish();
    return found;
}

/// Every point elsewhere, objects across others than before.
std::vector<Point> moved(std::vector<Point> points)
{
    for (std::size_t k = 0; k < points.size(); ++k) {
        points[k].x = 0.75f * points[k].x + 0.01f * static_cast<float>(k % 7);
        points[k].y += 0.01f * static_cast<float>(k % 5);
    }
    return points;
}

TEST(EmbreeCollider, FindsTheOraclesPairsOfHardMeshes)
{
    if (!is_built(make_embree_collider))
        GTEST_SKIP() << "built without Embree";
    for (const bool keep_adjacent : {true, false}) {
        const auto embree =
            make_embree_collider(session().programs(), {.keep_adjacent = keep_adjacent});
        for (const std::size_t size : {1u, 2u, 3u, 9u, 65u, 777u})
            for (const auto& [name, mesh] : hard_meshes(size)) {
                SCOPED_TRACE(name + ", " + std::to_string(size) + " triangles");
                const Input input = uploaded(mesh.points, mesh.faces);
                embree->reserve(nullptr, input);
                if (name == "huge")
                    EXPECT_THROW(found_by(*embree, input), Unavailable);
                else
                    EXPECT_EQ(found_by(*embree, input),
                              touching_pairs(mesh.points, mesh.faces, keep_adjacent));
            }
    }
}

/// Embree takes floats below the normal ones for zeros, and differences of normal ones that are below too.
TEST(EmbreeCollider, FindsTheOraclesPairsWhereFloatsEnd)
{
    if (!is_built(make_embree_collider))
        GTEST_SKIP() << "built without Embree";
    const auto embree = make_embree_collider(session().programs(), {});
    for (const std::size_t size : {1u, 2u, 5u, 65u, 777u})
        for (const auto& [scale, along] : {std::pair{0x1p-126f, 0x1p-126f},
                                           {0x1p-125f, -0x1p-126f},
                                           {0x1p-130f, 0x1p-99f},
                                           {0x1p-100f, -0x1p-101f},
                                           {0.0f, 0.0f},
                                           {0.0f, 1.0f},
                                           {0x1p-20f, 1e5f}}) {
            SCOPED_TRACE(std::to_string(size) + " triangles, " + std::to_string(scale * 0x1p120f) +
                         " at " + std::to_string(along * 0x1p120f));
            Mesh mesh = hard_inputs().front().make(size);
            for (Point& point : mesh.points)
                point = {point.x * scale + along, point.y * scale + along, point.z * scale + along};
            const Input input = uploaded(mesh.points, mesh.faces);
            embree->reserve(nullptr, input);
            EXPECT_EQ(found_by(*embree, input), touching_pairs(mesh.points, mesh.faces, true));
        }
}

TEST(EmbreeCollider, FindsTheOraclesPairsOfObjectsThatMove)
{
    if (!is_built(make_embree_collider))
        GTEST_SKIP() << "built without Embree";
    ManyObjects before({1, 70, 3, 2, 129, 200, 1});
    before.add({}, 0);
    // Two objects of one surface, which share vertices.
    const Mesh surface = hard_meshes(64).at(12).mesh;
    before.add(surface, 0.5f);
    const FaceRange whole = before.objects.back();
    before.objects.back().count /= 2;
    const uint rest = whole.first + before.objects.back().count;
    before.objects.push_back({rest, whole.first + whole.count - rest});
    std::fill(before.owners.begin() + rest, before.owners.end(), before.owners.back() + 1);
    ManyObjects after = before;
    after.mesh.points = moved(before.mesh.points);

    for (const Among among : all_kinds)
        for (const bool keep_adjacent : {true, false}) {
            SCOPED_TRACE(std::to_string(static_cast<int>(among)) + (keep_adjacent ? " kept" : ""));
            const auto embree = make_embree_collider(
                session().programs(), {.among = among, .keep_adjacent = keep_adjacent});
            EXPECT_FALSE(embree->needs_tree());
            EXPECT_FALSE(embree->finds_contacts());
            bool is_reserved = false;
            for (const ManyObjects* frame : {&before, &after, &before}) {
                const Input input = uploaded(frame->mesh.points, frame->mesh.faces, frame->objects);
                if (!std::exchange(is_reserved, true))
                    embree->reserve(nullptr, input);
                EXPECT_EQ(found_by(*embree, input), expected_pairs(*frame, among, keep_adjacent));
            }
        }
}

TEST(EmbreeCollider, RefusesAFrameWithCoordinatesItWouldDropTrianglesForAndTakesTheNext)
{
    if (!is_built(make_embree_collider))
        GTEST_SKIP() << "built without Embree";
    Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e18f, 0, 0}}, {{0, 1, 2}, {0, 1, 3}}};
    const auto embree = make_embree_collider(session().programs(), {});
    const Input input = uploaded(mesh.points, mesh.faces);
    embree->reserve(nullptr, input);
    EXPECT_EQ(found_by(*embree, input).size(), 1u);
    mesh.points.back().x = 1e19f;
    try {
        found_by(*embree, input);
        FAIL();
    } catch (const Unavailable& refusal) {
        EXPECT_STREQ(refusal.what(),
                     "Embree takes no coordinates beyond 1.8e18, and triangle 1 has some");
    }
    mesh.points.back().x = 3;
    EXPECT_EQ(found_by(*embree, input).size(), 1u);
}

TEST(EmbreeCollider, NamesItsStages)
{
    if (!is_built(make_embree_collider))
        GTEST_SKIP() << "built without Embree";
    const Mesh mesh = crowded_mesh(100);
    const Input input = uploaded(mesh.points, mesh.faces);
    const auto embree = make_embree_collider(session().programs(), {});
    embree->reserve(nullptr, input);
    embree->query(nullptr, input, session().queue());
    const std::vector<StageTime> stages = session().queue().finish();
    ASSERT_EQ(stages.size(), 2u);
    EXPECT_EQ(stages[0].stage, "hierarchy");
    EXPECT_EQ(stages[1].stage, "broad");
    EXPECT_GT(stages[0].wall_ns, 0);
}

/// Triangles of a soup, of several objects, that share few or many of its points. In general position: no three of
/// a triangle's points are with any other's in one plane, so that doubles tell what meets.
ManyObjects soup(std::size_t point_count, std::size_t face_count, unsigned seed)
{
    std::mt19937 random(seed);
    const auto number = [&](float below) {
        return below * static_cast<float>(random() >> 8) * 0x1p-24f;
    };
    ManyObjects many({});
    for (std::size_t k = 0; k < point_count; ++k)
        many.mesh.points.push_back({number(1), number(1), number(1)});
    const auto vertex = [&] { return static_cast<uint>(random() % point_count); };
    while (many.mesh.faces.size() < face_count) {
        const Face face = {vertex(), vertex(), vertex()};
        if (face.a != face.b && face.b != face.c && face.c != face.a)
            many.mesh.faces.push_back(face);
    }
    uint first = 0;
    for (const uint count : {1u, 40u, 0u, 3u, static_cast<uint>(face_count) - 44}) {
        many.objects.push_back({first, count});
        first += count;
        many.owners.resize(first, static_cast<uint>(many.objects.size() - 1));
    }
    return many;
}

/// Six times the volume between four points.
double volume(const Point& a, const Point& b, const Point& c, const Point& d)
{
    const double u[] = {double(b.x) - a.x, double(b.y) - a.y, double(b.z) - a.z};
    const double v[] = {double(c.x) - a.x, double(c.y) - a.y, double(c.z) - a.z};
    const double w[] = {double(d.x) - a.x, double(d.y) - a.y, double(d.z) - a.z};
    return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
           u[2] * (v[0] * w[1] - v[1] * w[0]);
}

bool is_pierced(const Point (&triangle)[3], const Point& from, const Point& to)
{
    const auto& [a, b, c] = triangle;
    if ((volume(a, b, c, from) > 0) == (volume(a, b, c, to) > 0))
        return false;
    const bool side = volume(from, to, a, b) > 0;
    return side == (volume(from, to, b, c) > 0) && side == (volume(from, to, c, a) > 0);
}

/// In general position two triangles meet where an edge of one goes through the other.
bool do_meet(std::span<const Point> points, Face one, Face other)
{
    const Point a[] = {points[one.a], points[one.b], points[one.c]};
    const Point b[] = {points[other.a], points[other.b], points[other.c]};
    for (std::size_t k = 0; k < 3; ++k)
        if (is_pierced(a, b[k], b[(k + 1) % 3]) || is_pierced(b, a[k], a[(k + 1) % 3]))
            return true;
    return false;
}

PairList pairs_that_meet(const ManyObjects& many, Among among)
{
    const auto& [points, faces] = many.mesh;
    std::vector<Pair> meet;
    for (uint a = 0; a < faces.size(); ++a)
        for (uint b = a + 1; b < faces.size(); ++b)
            if ((among == Among::all ||
                 (many.owners[a] != many.owners[b]) == (among == Among::between_objects)) &&
                !share_a_vertex(faces[a], faces[b]) && do_meet(points, faces[a], faces[b]))
                meet.push_back({a, b});
    return PairList(std::move(meet));
}

class FclCollider : public testing::TestWithParam<bool> {
protected:
    static bool is_refit() { return GetParam(); }
    static std::unique_ptr<Collider> made(const ColliderOptions& options)
    {
        const MakeCollider make = is_refit() ? make_fcl_refit_collider : make_fcl_collider;
        return make(session().programs(), options);
    }

    void SetUp() override
    {
        if (!is_built(make_fcl_collider))
            GTEST_SKIP() << "built without FCL";
    }
};

TEST_P(FclCollider, FindsThePairsThatMeetAsPointsMove)
{
    for (const std::size_t point_count : {60u, 900u})
        for (const Among among : all_kinds) {
            SCOPED_TRACE(std::to_string(point_count) + " points, " +
                         std::to_string(static_cast<int>(among)));
            const auto fcl = made({.among = among, .keep_adjacent = false});
            EXPECT_TRUE(fcl->finds_contacts());
            EXPECT_FALSE(fcl->needs_tree());
            ManyObjects frame = soup(point_count, 300, 1);
            const Input input = uploaded(frame.mesh.points, frame.mesh.faces, frame.objects);
            fcl->reserve(nullptr, input);
            for (unsigned seed = 1; seed <= 3; ++seed) {
                // The input sees the points as they move.
                const std::vector<Point> elsewhere = soup(point_count, 300, seed).mesh.points;
                std::copy(elsewhere.begin(), elsewhere.end(), frame.mesh.points.begin());
                const PairList expected = pairs_that_meet(frame, among);
                EXPECT_GT(expected.size(), 100u);
                EXPECT_EQ(found_by(*fcl, input), expected);
            }
        }
}

TEST_P(FclCollider, FindsNothingOnASingleTriangle)
{
    const Mesh mesh = crowded_mesh(1);
    const Input input = uploaded(mesh.points, mesh.faces);
    const auto fcl = made({.keep_adjacent = false});
    fcl->reserve(nullptr, input);
    EXPECT_EQ(found_by(*fcl, input).size(), 0u);
}

TEST_P(FclCollider, RefusesToKeepAdjacentPairs)
{
    try {
        made({});
        FAIL();
    } catch (const BadUsage& refusal) {
        EXPECT_TRUE(std::string(refusal.what())
                        .starts_with(is_refit() ? "fcl-refit cannot keep adjacent triangles"
                                                : "fcl cannot keep adjacent triangles"))
            << refusal.what();
    }
}

INSTANTIATE_TEST_SUITE_P(Trees, FclCollider, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "refit" : "built"; });

/// What a separate program counted on two frames each of a cloth and of 305 balls, with exact arithmetic.
class LibraryReference : public testing::TestWithParam<const char*> {};

TEST_P(LibraryReference, CountedWhatTheLibraryFinds)
{
    const ColliderEntry& entry = find_collider(GetParam());
    if (entry.make == nullptr)
        GTEST_SKIP() << entry.absent;
    const char* data = std::getenv("BVHBENCH_DATA");
    if (data == nullptr || *data == '\0')
        GTEST_SKIP() << "BVHBENCH_DATA is not set: nothing is compared with the data sets";
    for (const char* name : {"unc_cloth_ball", "unc_nbody"}) {
        const std::filesystem::path folder = std::filesystem::path(data) / "dynamic" / name;
        std::ifstream in(folder / "meta.json");
        const nlohmann::json meta = nlohmann::json::parse(in);
        const DataSetMesh mesh = read_data_set_mesh(folder / "mesh.ply");
        std::vector<FaceRange> objects;
        for (const nlohmann::json& object : meta["objects"])
            objects.push_back({object["face_first"], object["face_count"]});
        const auto frames = read_frames(folder / "frames.f32", meta["frames"], mesh.points.size());
        const auto whole =
            make_collider(GetParam(), session().programs(), {.keep_adjacent = false});
        const auto between =
            make_collider(GetParam(), session().programs(),
                          {.among = Among::between_objects, .keep_adjacent = false});
        const std::string kind = whole->finds_contacts() ? "exact_" : "aabb_";
        for (std::size_t k = 0; k < frames.size(); ++k) {
            SCOPED_TRACE(std::string(name) + ", frame " + std::to_string(k));
            const nlohmann::json& reference = meta["reference"][k];
            const Input input = uploaded(frames[k], mesh.faces, objects);
            if (k == 0) {
                whole->reserve(nullptr, input);
                between->reserve(nullptr, input);
            }
            const std::size_t pairs_between = reference[kind + "inter"];
            const std::size_t pairs_within = reference[kind + "self_nonadj"];
            const PairList found = found_by(*whole, input);
            EXPECT_EQ(found.size(), pairs_between + pairs_within);
            EXPECT_EQ(hex(found.hash()), reference[kind + "hash"]);
            EXPECT_EQ(found_by(*between, input).size(), pairs_between);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Libraries, LibraryReference, testing::Values("embree", "fcl", "fcl-refit"),
                         [](const auto& tested) { return test_name(tested.param); });

TEST(LibraryColliders, AreListedAndRefusedWhereTheyWereNotBuilt)
{
    for (const char* name : {"embree", "fcl", "fcl-refit"}) {
        const ColliderEntry& entry = find_collider(name);
        if (entry.make != nullptr) {
            EXPECT_EQ(
                make_collider(name, session().programs(), {.keep_adjacent = false})->card().name,
                name);
            continue;
        }
        EXPECT_TRUE(entry.absent.starts_with("built without ")) << entry.absent;
        EXPECT_THROW(make_collider(name, session().programs(), {}), Unavailable);
    }
    EXPECT_THROW(make_collider("embre", session().programs(), {}), BadUsage);
}

}  // namespace
}  // namespace bvhbench
