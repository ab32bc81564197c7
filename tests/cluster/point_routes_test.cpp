// SPDX-License-Identifier: MIT
#include "cluster/point_routes.h"

#include <gtest/gtest.h>

#include <numeric>

#include "geometry/error.h"
#include "tests/cluster/thread_ranks.h"

namespace bvhbench {
namespace {

constexpr uint vertex_count = 40;

Point point_of(uint vertex, uint giver)
{
    return {static_cast<float>(vertex), static_cast<float>(giver), 0};
}

/// Returns a share of the triangles k, k + 1, k + 2 whose k leaves this remainder.
Share share_of_rank(uint rank, uint count)
{
    std::vector<CarriedTriangle> carried;
    for (uint k = rank; k + 2 < vertex_count; k += count)
        carried.push_back({k, {k, k + 1, k + 2}, {}});
    return share_of({carried});
}

/// Each rank gives the vertices for which `gives` is true, in descending order. Expects each point of each share to come from the
/// lowest rank that gives it.
void hold_routes(uint count, const std::function<bool(uint rank, uint vertex)>& gives)
{
    on_ranks(count, [&](Ranks& ranks) {
        std::vector<uint> given;
        for (uint vertex = vertex_count; vertex-- > 0;)
            if (gives(ranks.rank(), vertex))
                given.push_back(vertex);
        const Share share = share_of_rank(ranks.rank(), count);
        const PointRoutes routes(given, share, ranks);
        std::vector<Point> points;
        for (const uint vertex : given)
            points.push_back(point_of(vertex, ranks.rank()));
        for (int frame = 0; frame < 2; ++frame) {
            const std::vector<Point> sent = routes.sent(points, ranks);
            ASSERT_EQ(sent.size(), share.vertices.size());
            for (std::size_t k = 0; k < sent.size(); ++k) {
                const uint vertex = share.vertices[k];
                uint giver = 0;
                while (!gives(giver, vertex))
                    ++giver;
                EXPECT_EQ(sent[k].x, static_cast<float>(vertex + static_cast<uint>(frame)));
                EXPECT_EQ(sent[k].y, static_cast<float>(giver));
            }
            for (Point& point : points)
                ++point.x;
        }
    });
}

TEST(PointRoutes, BringPointsFromWhoeverGivesThem)
{
    for (const uint count : {1u, 2u, 5u}) {
        hold_routes(count, [](uint rank, uint) { return rank == 0; });
        hold_routes(count, [count](uint rank, uint) { return rank == count - 1; });
        hold_routes(count, [count](uint rank, uint vertex) { return vertex / 7 % count == rank; });
        hold_routes(count, [](uint, uint) { return true; });
    }
}

TEST(PointRoutes, RefuseAVertexThatNoRankGives)
{
    std::vector<uint> given(vertex_count - 1);
    std::iota(given.begin(), given.end(), 0u);
    on_ranks(1, [&](Ranks& ranks) {
        EXPECT_THROW(PointRoutes(given, share_of_rank(0, 1), ranks), BadUsage);
    });
}

}  // namespace
}  // namespace bvhbench
