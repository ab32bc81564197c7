// SPDX-License-Identifier: MIT
//
// The hashed grid of one object or many over several frames, and its arithmetic. collider_test has the hard meshes.
#include <limits>

#include "collide/grid/hash_grid.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

/// Returns a mesh with integer corners: boxes that only touch, at borders of cells.
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

class GridCollider : public testing::TestWithParam<KernelForm> {
protected:
    std::unique_ptr<Collider> made(ColliderOptions options = {}) const
    {
        options.form = GetParam();
        return bvhbench::made("grid", options);
    }
};

TEST_P(GridCollider, FindsTheOraclesPairsOnManyLevels)
{
    expect_oracles_pairs(*made(), Standing(mesh_of_many_sizes(5000), nullptr));
}

TEST_P(GridCollider, KeepsUpWithPointsThatMoveAndFacesThatGrow)
{
    Standing standing(mesh_of_many_sizes(1500), nullptr);
    const auto grid = made();
    grid->reserve(nullptr, standing.input);
    std::vector<Point> points = standing.mesh.points;
    for (const float factor : {1.0f, 3.0f, 0.01f, -40.0f}) {
        for (std::size_t k = 0; k < points.size(); k += 3)
            points[k].x *= factor;  // triangles change size, and with it their level
        standing.place(points);
        expect_pairs(*grid, standing, standing.expected(true));
    }
}

TEST_P(GridCollider, TellsObjectsApart)
{
    ManyObjects many({});
    for (const uint size : {1u, 70u, 3u, 200u})
        many.add(mesh_of_many_sizes(size));
    expect_pairs_of_objects(many, [&](const ColliderOptions& options) { return made(options); });
}

TEST_P(GridCollider, TestsLittleMoreThanThereIsWhereAllBoxesAreAlike)
{
    const auto grid = made();
    expect_oracles_pairs(*grid, Standing(mesh_of_touching_boxes(), nullptr));
    const QueryCounts counts = grid->counts(session().queue());
    EXPECT_LT(counts.box_tests, 8 * counts.pairs);
}

INSTANTIATE_TEST_SUITE_P(Forms, GridCollider, both_forms, CaseName());

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
    std::vector<NamedMesh> meshes = hard_meshes(1000);
    meshes.push_back({"many sizes", mesh_of_many_sizes(1000)});
    for (const auto& [name, mesh] : meshes) {
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
