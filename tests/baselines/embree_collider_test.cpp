// SPDX-License-Identifier: MIT
//
// Embree's collider, which builds its own trees: it is reserved once and then queried for frames whose points move.

#include "tests/baselines/library_colliders.h"
#include "tests/collide/many_objects.h"
#include "tests/refusal.h"

namespace bvhbench {
namespace {

using EmbreeCollider = OfALibrary<make_embree_collider, make_embree_refit_collider, embree_absent>;

TEST_P(EmbreeCollider, FindsTheOraclesPairsOfHardMeshes)
{
    for (const bool keep_adjacent : {true, false}) {
        const auto embree = made({.keep_adjacent = keep_adjacent});
        for (const std::size_t size : {1u, 2u, 3u, 9u, 65u, 777u})
            for (const auto& [name, mesh] : hard_meshes(size)) {
                SCOPED_TRACE(name + ", " + std::to_string(size) + " triangles");
                const Input input = uploaded(mesh.points, mesh.faces);
                const auto found = [&] {
                    embree->reserve(nullptr, input);
                    return found_by(*embree, input);
                };
                if (name == "huge")
                    EXPECT_THROW(found(), Unavailable);
                else
                    EXPECT_EQ(found(), touching_pairs(mesh.points, mesh.faces, keep_adjacent));
            }
    }
}

/// Embree treats subnormal floats as zeros, and subnormal differences of normal floats, too.
TEST_P(EmbreeCollider, FindsTheOraclesPairsWhereFloatsEnd)
{
    const auto embree = made({});
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

TEST_P(EmbreeCollider, FindsTheOraclesPairsOfObjectsThatMove)
{
    ManyObjects before({1, 70, 3, 2, 129, 200, 1});
    before.add({}, 0);
    // Two objects that are halves of one surface and share vertices.
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
            const auto embree = made({.among = among, .keep_adjacent = keep_adjacent});
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

TEST_P(EmbreeCollider, RefusesAFrameWithCoordinatesItWouldDropTrianglesForAndTakesTheNext)
{
    Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e18f, 0, 0}}, {{0, 1, 2}, {0, 1, 3}}};
    const auto embree = made({});
    const Input input = uploaded(mesh.points, mesh.faces);
    embree->reserve(nullptr, input);
    EXPECT_EQ(found_by(*embree, input).size(), 1u);
    mesh.points.back().x = 1e19f;
    EXPECT_EQ(refusal_of([&] { found_by(*embree, input); }),
              "Embree takes no coordinates beyond 1.8e18, and triangle 1 has some");
    mesh.points.back().x = 3;
    EXPECT_EQ(found_by(*embree, input).size(), 1u);
}

TEST_P(EmbreeCollider, NamesItsStages)
{
    const Mesh mesh = crowded_mesh(100);
    const Input input = uploaded(mesh.points, mesh.faces);
    const auto embree = made({});
    embree->reserve(nullptr, input);
    embree->query(nullptr, input, session().queue());
    const std::vector<StageTime> stages = session().queue().finish();
    ASSERT_EQ(stages.size(), 2u);
    EXPECT_EQ(stages[0].stage, is_refit() ? "refit" : "hierarchy");
    EXPECT_EQ(stages[1].stage, "broad");
    EXPECT_GT(stages[0].wall_ns, 0);
}

/// Embree's nodes of eight children take at least 8 bytes a triangle, its leaves 8.
TEST_P(EmbreeCollider, TellsWhatEmbreeHolds)
{
    const auto bytes_of = [](std::size_t triangles) {
        const Mesh mesh = crowded_mesh(triangles);
        const Input input = uploaded(mesh.points, mesh.faces);
        const auto embree = made({});
        embree->reserve(nullptr, input);
        found_by(*embree, input);
        return embree->reserved().tree_bytes;
    };
    EXPECT_GT(bytes_of(20000), bytes_of(2000) + 16 * 18000);
    EXPECT_LT(bytes_of(20000), 1000 * 20000);
}

INSTANTIATE_TEST_SUITE_P(Trees, EmbreeCollider, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "refit" : "built"; });

}  // namespace
}  // namespace bvhbench
