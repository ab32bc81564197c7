// SPDX-License-Identifier: MIT
#include "cluster/share.h"

#include <gtest/gtest.h>

#include "tests/cluster/thread_ranks.h"

namespace bvhbench {
namespace {

/// A strip of triangles over a line of points, each of which shares vertices with its neighbours.
Mesh strip_of(uint triangles)
{
    Mesh mesh;
    for (uint k = 0; k < triangles + 2; ++k)
        mesh.points.push_back({static_cast<float>(k), static_cast<float>(k % 2), 0});
    for (uint k = 0; k < triangles; ++k)
        mesh.faces.push_back({k + 2, k, k + 1});
    return mesh;
}

/// Adds to `seen` which triangles the share has; each must be as in the mesh.
void hold_to(const Mesh& mesh, const Share& share, std::vector<int>& seen)
{
    EXPECT_TRUE(std::ranges::is_sorted(share.ids));
    ASSERT_EQ(share.faces.size(), share.ids.size());
    ASSERT_EQ(share.points.size(), share.vertices.size());
    for (std::size_t k = 0; k < share.ids.size(); ++k) {
        const Face wanted = mesh.faces.at(share.ids[k]), face = share.scene_face(k);
        EXPECT_TRUE(face.a == wanted.a && face.b == wanted.b && face.c == wanted.c);
        const Point at = share.points[share.faces[k].b], there = mesh.points[wanted.b];
        EXPECT_TRUE(at.x == there.x && at.y == there.y && at.z == there.z);
        ++seen[share.ids[k]];
    }
}

TEST(Share, IsDealtAndMovedWhole)
{
    for (const uint triangles : {1u, 2u, 100u})
        for (const uint count : {1u, 2u, 5u}) {
            const Mesh mesh = strip_of(triangles);
            std::vector<std::vector<int>> dealt_to(count), moved_to(count);
            on_ranks(count, [&](Ranks& ranks) {
                dealt_to[ranks.rank()].resize(triangles);
                moved_to[ranks.rank()].resize(triangles);
                const Mesh none;
                const Mesh& has = ranks.rank() == count - 1 ? mesh : none;
                Share share = dealt(has.points, has.faces, count - 1, ranks);
                EXPECT_LE(share.triangle_count(), (triangles + count - 1) / count);
                hold_to(mesh, share, dealt_to[ranks.rank()]);
                std::vector<uint> to;
                for (const uint id : share.ids)
                    to.push_back(id * 7 % count);
                share = moved(share, to, ranks);
                for (const uint id : share.ids)
                    EXPECT_EQ(id * 7 % count, ranks.rank());
                hold_to(mesh, share, moved_to[ranks.rank()]);
            });
            for (uint k = 0; k < triangles; ++k) {
                int dealt_times = 0, moved_times = 0;
                for (uint rank = 0; rank < count; ++rank) {
                    dealt_times += dealt_to[rank][k];
                    moved_times += moved_to[rank][k];
                }
                EXPECT_EQ(dealt_times, 1);
                EXPECT_EQ(moved_times, 1);
            }
        }
}

TEST(Share, HasOnlyTheVerticesOfItsTriangles)
{
    const Share share = share_of({{{9, {70, 3, 12}, {{7, 0, 0}, {3, 0, 0}, {1, 2, 0}}}},
                                  {},
                                  {{4, {3, 5, 70}, {{3, 0, 0}, {5, 0, 0}, {7, 0, 0}}}}});
    EXPECT_EQ(share.ids, (std::vector<uint>{4, 9}));
    EXPECT_EQ(share.vertices, (std::vector<uint>{3, 5, 12, 70}));
    EXPECT_EQ(share.points[3].x, 7);
}

TEST(Share, OfARunHasItsVerticesOnly)
{
    const Share share = share_of(MeshRun{{{70, 3, 12}, {3, 12, 200}},
                                         {{3, 0, 0}, {1, 2, 0}, {7, 0, 0}, {8, 0, 0}},
                                         {3, 12, 70, 200}},
                                 5);
    EXPECT_EQ(share.ids, (std::vector<uint>{5, 6}));
    EXPECT_EQ(share.scene_face(1).c, 200u);
    EXPECT_EQ(share.points[share.faces[0].a].x, 7);
    EXPECT_EQ(share_of(MeshRun{}, 5).triangle_count(), 0u);
}

}  // namespace
}  // namespace bvhbench
