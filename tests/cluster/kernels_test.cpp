// SPDX-License-Identifier: MIT
//
// The kernels of this room, one rank at a time, against their definitions on the host.
#include <cstring>
#include <tuple>

#include "cluster/halo.h"
#include "cluster/halo_query.h"
#include "cluster/leaving.h"
#include "cluster/top_boxes.h"
#include "tests/collide/collider_testing.h"

namespace bvhbench {
namespace {

bool same(const Aabb& a, const Aabb& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// A mesh cut in two, with the tree of the first half.
class Halves : public testing::TestWithParam<const char*> {
protected:
    Halves()
    {
        const std::size_t half = mesh_.faces.size() / 2;
        own_ = {mesh_.faces.begin(), mesh_.faces.begin() + half};
        others_ = {mesh_.faces.begin() + half, mesh_.faces.end()};
        input_ = upload(session().device(), queue(), mesh_.points, own_);
        builder_ = make_builder({.name = GetParam()}, session().programs());
        builder_->reserve(input_.triangle_count());
        tree_ = &dynamic_cast<const DeviceTree&>(builder_->build(input_, queue()));
        queue().finish();
    }

    std::vector<Aabb> tops()
    {
        TopBoxes tops(session().programs(), usual_top_boxes);
        tops.reserve(*tree_);
        return tops.read(*tree_, queue());
    }

    Queue& queue() { return session().queue(); }

    Mesh mesh_ = scene_mesh("torus:400");
    std::vector<Face> own_, others_;
    Input input_;
    std::unique_ptr<Builder> builder_;
    const DeviceTree* tree_ = nullptr;
};

TEST_P(Halves, TopBoxesTogetherAreTheBoxesOfALevel)
{
    Aabb all = empty_box(), of_tops = empty_box();
    const std::vector<Aabb> tops = this->tops();
    for (const Aabb& top : tops)
        of_tops = merged(of_tops, top);
    for (const Face& face : own_) {
        const Aabb box = face_box(mesh_.points, face);
        all = merged(all, box);
        EXPECT_TRUE(std::ranges::any_of(
            tops, [&](const Aabb& top) { return same(merged(top, box), top); }));
    }
    EXPECT_TRUE(same(of_tops, all));
    EXPECT_GT(std::ranges::count_if(tops, [](const Aabb& top) { return top.min_x <= top.max_x; }),
              16);
}

TEST_P(Halves, LeavingTrianglesAreThoseOfTheHost)
{
    std::vector<Aabb> tops = this->tops();
    for (const uint rank : {1u, 2u, 3u})  // boxes of other ranks: single triangles of each half
        for (uint k = 0; k < usual_top_boxes; ++k)
            tops.push_back(
                k < 20 ? face_box(mesh_.points, (k % 2 == 0 ? own_ : others_)[20 * rank + k])
                       : empty_box());
    const WantedBoxes wanted = wanted_from(0, tops, 4);
    const std::vector<Pair> right = bvhbench::leaving(face_boxes(mesh_.points, own_), wanted);
    for (const uint rank : {1u, 3u})
        EXPECT_TRUE(std::ranges::any_of(right, [&](Pair pair) { return pair.b == rank; }));
    Share share = {{}, own_, mesh_.points, {}};
    for (uint k = 0; k < own_.size(); ++k)
        share.ids.push_back(3 * k + 5);
    for (uint k = 0; k < mesh_.points.size(); ++k)
        share.vertices.push_back(2 * k + 7);
    for (const bool with_vertices : {false, true}) {
        Leaving leaving(session().programs(), with_vertices);
        leaving.own(share);
        leaving.reserve(nullptr, input_);
        leaving.want(wanted, queue());
        find_pairs(leaving, nullptr, input_, queue());
        std::vector<Pair> found = leaving.pairs(queue());
        std::vector<HaloTriangle> packed;
        leaving.read_packed(packed, found.size(), queue());
        for (std::size_t k = 0; k < found.size(); ++k) {
            const uint own = found[k].a;
            EXPECT_TRUE(same(packed[k].box, face_box(mesh_.points, own_[own])));
            EXPECT_EQ(packed[k].id, share.ids[own]);
            const Face face = share.scene_face(own), vertices = packed[k].vertices;
            EXPECT_TRUE(!with_vertices ||
                        (face.a == vertices.a && face.b == vertices.b && face.c == vertices.c));
        }
        std::ranges::sort(found,
                          [](Pair a, Pair b) { return std::tie(a.a, a.b) < std::tie(b.a, b.b); });
        EXPECT_EQ(found, right);
    }
}

TEST_P(Halves, PairsWithTheHaloAreThoseOfTheDefinition)
{
    std::vector<HaloTriangle> halo;
    std::vector<Pair> right[2];  // by keep_adjacent
    const auto own_count = static_cast<uint>(own_.size());
    for (uint k = 0; k < others_.size(); ++k) {
        halo.push_back({face_box(mesh_.points, others_[k]), own_count + k, others_[k]});
        for (uint own = 0; own < own_count; ++own)
            if (overlap(halo.back().box, face_box(mesh_.points, own_[own]))) {
                right[1].push_back({own, own_count + k});
                if (!share_a_vertex(own_[own], others_[k]))
                    right[0].push_back({own, own_count + k});
            }
    }
    for (const bool keep_adjacent : {false, true}) {
        HaloQuery query(session().programs(), keep_adjacent);
        query.own(own_);
        query.reserve(tree_, input_);
        query.bring(halo, queue());
        find_pairs(query, tree_, input_, queue());
        EXPECT_EQ(PairList(query.pairs(queue())),
                  PairList(std::move(right[keep_adjacent ? 1 : 0])));
    }
}

INSTANTIATE_TEST_SUITE_P(Trees, Halves,
                         testing::Values("oibvh-multi", "karras", "perfect", "oibvh-wide4"),
                         CaseName());

}  // namespace
}  // namespace bvhbench
