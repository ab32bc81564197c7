// SPDX-License-Identifier: MIT
//
// The hashed grid finds the oracle's pairs: on every mesh that is hard, of one object or many, frame after frame.
#include <cmath>
#include <limits>
#include <random>

#include "collide/grid/hash_grid.h"
#include "collide/relation.h"
#include "tests/collide/collider_testing.h"

namespace bvhbench {
namespace {

constexpr std::size_t few_sizes[] = {1, 2, 3, 4, 5, 8, 9, 33, 64, 65};

/// Sides from a thousandth to a hundred, so that many levels are in use.
Mesh mesh_of_many_sizes(uint count)
{
    std::mt19937 engine{7};
    const auto random = [&] { return static_cast<float>(engine() >> 8) * 0x1p-24f; };
    Mesh mesh;
    for (uint k = 0; k < count; ++k) {
        const float side = 0.001f * std::pow(10.0f, 5 * random() * random() * random());
        const Point at{4 * random() - 2, 4 * random() - 2, 4 * random() - 2};
        mesh.points.insert(mesh.points.end(), {at,
                                               {at.x + side * random(), at.y + side, at.z},
                                               {at.x, at.y - side, at.z + side * random()}});
        mesh.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    return mesh;
}

/// Corners on whole numbers: boxes that only touch, where cells touch as well.
Mesh mesh_of_touching_boxes()
{
    Mesh mesh;
    for (uint k = 0; k < 512; ++k) {
        const auto x = static_cast<float>(k % 8), y = static_cast<float>(k / 8 % 8),
                   z = static_cast<float>(k / 64);
        mesh.points.insert(mesh.points.end(),
                           {{x - 4, y - 4, z - 4}, {x - 3, y - 3, z - 4}, {x - 4, y - 4, z - 3}});
        mesh.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    return mesh;
}

std::vector<NamedMesh> meshes(std::size_t count)
{
    std::vector<NamedMesh> all = hard_meshes(count);
    all.push_back({"many sizes", mesh_of_many_sizes(static_cast<uint>(count))});
    return all;
}

/// One query, repeated until complete; how many that took.
int expect_pairs(Collider& grid, const Input& input, const PairList& expected)
{
    const int queries = find_pairs(grid, nullptr, input, session().queue());
    const PairList found(grid.pairs(session().queue()));
    session().queue().finish();
    EXPECT_EQ(found.surplus(), 0u);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(grid.counts(session().queue()).pairs, found.size());
    return queries;
}

Input uploaded(const Mesh& mesh, std::span<const FaceRange> objects = {})
{
    return upload(session().device(), session().queue(), mesh.points, mesh.faces, objects);
}

class GridCollider : public testing::TestWithParam<KernelForm> {
protected:
    std::unique_ptr<Collider> made(ColliderOptions options) const
    {
        options.form = GetParam();
        return find_collider("grid").make(session().programs(), options);
    }

    void expect_oracles_pairs_of(const std::vector<NamedMesh>& all,
                                 const ColliderOptions& options) const
    {
        const auto grid = made(options);
        for (const auto& [name, mesh] : all) {
            SCOPED_TRACE(name + ", " + std::to_string(mesh.faces.size()) + " triangles");
            const Input input = uploaded(mesh);
            grid->reserve(nullptr, input);
            expect_pairs(*grid, input,
                         touching_pairs(mesh.points, mesh.faces, options.keep_adjacent));
        }
    }
};

TEST_P(GridCollider, FindsTheOraclesPairsOfFew)
{
    for (const std::size_t size : few_sizes)
        expect_oracles_pairs_of(meshes(size), {});
}

TEST_P(GridCollider, FindsTheOraclesPairsOfMany)
{
    for (const bool keep_adjacent : {true, false})
        expect_oracles_pairs_of(meshes(777), {.keep_adjacent = keep_adjacent});
    expect_oracles_pairs_of(
        {{"touching", mesh_of_touching_boxes()}, {"many sizes", mesh_of_many_sizes(5000)}}, {});
}

TEST_P(GridCollider, DropsNothingWhenBuffersBeginWithOneEntry)
{
    expect_oracles_pairs_of(meshes(300), {.capacity = 1});
}

TEST_P(GridCollider, TakesEveryGroupSizeThatItSaysItDoes)
{
    for (const unsigned group_size : {8u, 16u, 256u})
        expect_oracles_pairs_of({{"many sizes", mesh_of_many_sizes(1000)}},
                                {.group_size = group_size});
}

TEST_P(GridCollider, CountsTheSameEveryTime)
{
    const Mesh mesh = mesh_of_many_sizes(2000);
    const Input input = uploaded(mesh);
    const auto grid = made({});
    grid->reserve(nullptr, input);
    const PairList expected = touching_pairs(mesh.points, mesh.faces, true);
    expect_pairs(*grid, input, expected);
    const QueryCounts first = grid->counts(session().queue());
    for (int repeat = 0; repeat < 5; ++repeat) {
        EXPECT_EQ(expect_pairs(*grid, input, expected), 1);
        EXPECT_EQ(grid->counts(session().queue()).box_tests, first.box_tests);
    }
}

TEST_P(GridCollider, KeepsUpWithPointsThatMoveAndFacesThatGrow)
{
    Mesh mesh = mesh_of_many_sizes(1500);
    Input input = uploaded(mesh);
    const auto grid = made({});
    grid->reserve(nullptr, input);
    for (const float factor : {1.0f, 3.0f, 0.01f, -40.0f}) {
        for (std::size_t k = 0; k < mesh.points.size(); k += 3)
            mesh.points[k].x *=
                factor;  // triangles change their sizes, and so the levels they are on
        input.device_points.upload(session().queue().cl(), mesh.points);
        expect_pairs(*grid, input, touching_pairs(mesh.points, mesh.faces, true));
    }
}

TEST_P(GridCollider, TellsObjectsApart)
{
    Mesh mesh;
    std::vector<FaceRange> objects;
    for (const std::size_t size : {1u, 70u, 3u, 200u}) {
        const Mesh part = mesh_of_many_sizes(static_cast<uint>(size));
        const auto base = static_cast<uint>(mesh.points.size());
        objects.push_back({static_cast<uint>(mesh.faces.size()), static_cast<uint>(size)});
        mesh.points.insert(mesh.points.end(), part.points.begin(), part.points.end());
        for (const Face& face : part.faces)
            mesh.faces.push_back({face.a + base, face.b + base, face.c + base});
    }
    const PairList all = touching_pairs(mesh.points, mesh.faces, true);
    const std::vector<FaceRange> one = {{0, static_cast<uint>(mesh.faces.size())}};
    for (const std::vector<FaceRange>& ranges : {objects, one})
        for (const Among among : {Among::all, Among::between_objects, Among::within_objects})
            for (const std::size_t capacity : {0u, 1u}) {
                SCOPED_TRACE(std::to_string(ranges.size()) + " objects, among " +
                             std::to_string(static_cast<int>(among)));
                const Input input = uploaded(mesh, ranges);
                const auto grid = made({.among = among, .capacity = capacity});
                grid->reserve(nullptr, input);
                expect_pairs(*grid, input, among_objects(all, ranges, among));
            }
}

TEST_P(GridCollider, TestsLittleMoreThanThereIsWhereAllBoxesAreAlike)
{
    const Mesh mesh = mesh_of_touching_boxes();
    const Input input = uploaded(mesh);
    const auto grid = made({});
    grid->reserve(nullptr, input);
    const PairList expected = touching_pairs(mesh.points, mesh.faces, true);
    expect_pairs(*grid, input, expected);
    EXPECT_LT(grid->counts(session().queue()).box_tests, 8 * expected.size());
}

INSTANTIATE_TEST_SUITE_P(Forms, GridCollider,
                         testing::Values(KernelForm::groups, KernelForm::chunks),
                         [](const auto& tested) {
                             return tested.param == KernelForm::groups ? "groups" : "chunks";
                         });

TEST(HashGrid, NeverFallsWhereACoordinateRises)
{
    for (const float scale : {0.0f, 1e-38f, 0.37f, 1.0f, 3e7f, 8.5e37f}) {
        int before = cell_along(-std::numeric_limits<float>::max(), scale);
        for (float x : {-1e38f, -1e9f, -3.0f, -2.9999998f, -1e-3f, -1e-40f, 0.0f, 1e-45f, 1e-3f,
                        0.99999994f, 1.0f, 2.7f, 1e9f, 3.4e38f}) {
            const int here = cell_along(x, scale);
            EXPECT_LE(before, here) << x << " times " << scale;
            before = here;
        }
    }
    EXPECT_EQ(cell_along(-0.5f, 1), -1);
    EXPECT_EQ(cell_along(-1, 1), -1);
    EXPECT_EQ(cell_along(1, 1), 1);
    EXPECT_EQ(cell_along(2.5f, 2), 5);
}

TEST(HashGrid, HasNoMoreThanThreeCellsAnAxisForABoxOfItsLevel)
{
    for (const auto& [name, mesh] : meshes(1000)) {
        SCOPED_TRACE(name);
        double mean = 0;
        for (const Face& face : mesh.faces)
            mean += half_longest(face_box(mesh.points, face)) / 1000.0;
        const auto scale = static_cast<float>(std::min(0.25 / mean, 8.5e37));
        for (const Face& face : mesh.faces) {
            const Aabb box = face_box(mesh.points, face);
            const CellRange range = cells_of_box(box, level_scale(scale, level_of_box(box, scale)));
            ASSERT_LE(range.high_x - range.low_x, 2);
            ASSERT_LE(range.high_y - range.low_y, 2);
            ASSERT_LE(range.high_z - range.low_z, 2);
        }
    }
}

TEST(HashGrid, NumbersTheCellsOfABoxDifferently)
{
    EXPECT_EQ(level_of_number(cell_number(15, -1, 7, 511)), 15u);
    std::vector<uint> numbers;
    for (int z = -2; z < 6; ++z)
        for (int y = -1; y < 7; ++y)
            for (int x = 508; x < 516; ++x)
                numbers.push_back(cell_number(3, x, y, z));
    std::sort(numbers.begin(), numbers.end());
    EXPECT_EQ(std::adjacent_find(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace
}  // namespace bvhbench
