// SPDX-License-Identifier: MIT
//
// FCL's colliders, which keep their own trees: each is reserved once and then queried for frames whose points move.
#include <iterator>

#include "collide/narrow/exact_contact.h"
#include "tests/baselines/library_colliders.h"
#include "tests/collide/many_objects.h"
#include "tests/refusal.h"

namespace bvhbench {
namespace {

/// Returns a triangle soup of several objects whose triangles share few or many points. The points are in general position: no
/// four of them lie in one plane, so doubles decide correctly which triangles intersect.
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

PairList pairs_that_meet(const ManyObjects& many, Among among)
{
    const auto& [points, faces] = many.mesh;
    const auto corners = [&](uint k) {
        return Corners{{points[faces[k].a], points[faces[k].b], points[faces[k].c]}};
    };
    const PairList near = expected_pairs(many, among, false);
    std::vector<Pair> meet;
    std::ranges::copy_if(near.pairs(), std::back_inserter(meet), [&](Pair pair) {
        return triangles_meet(corners(pair.a), corners(pair.b));
    });
    return PairList(std::move(meet));
}

using FclCollider = OfALibrary<make_fcl_collider, make_fcl_refit_collider, fcl_absent>;

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
                // `input` refers to the frame's points, which change here.
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
    const std::string why = refusal_of<BadUsage>([] { made({}); });
    EXPECT_TRUE(why.starts_with(is_refit() ? "fcl-refit cannot keep adjacent triangles"
                                           : "fcl cannot keep adjacent triangles"))
        << why;
}

INSTANTIATE_TEST_SUITE_P(Trees, FclCollider, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "refit" : "built"; });

}  // namespace
}  // namespace bvhbench
