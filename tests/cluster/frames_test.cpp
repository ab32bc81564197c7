// SPDX-License-Identifier: MIT
//
// Frames over ranks that are processes: the pairs of all ranks together are those of the oracle, each found once.
#include "cluster/frame.h"

#include "cluster/partition.h"
#include "cluster/reach.h"
#include "collide/narrow/narrow.h"
#include "collide/oracles/sweep.h"
#include "harness/choice/catalog.h"
#include "harness/judge/hard_inputs.h"
#include "harness/measure/cluster.h"
#include "tests/baselines/testing.h"
#include "tests/cluster/rank_tests.h"
#include "tests/folder.h"

namespace bvhbench {
namespace {

/// One of each kind of tree and of walk. The last is of wide nodes, and leaves pairs out.
const std::vector<PipelineChoice> pipelines = {
    {{.name = "oibvh-multi"}, {.name = "leaf"}},
    {{.name = "karras"}, {{.keep_adjacent = false}, "group"}},
    {{.name = "perfect"}, {.name = "block"}},
    {{.name = "oibvh-wide8"}, {{.keep_adjacent = false}, "bvtt"}}};

class Frames : public testing::Test {
protected:
    /// What the frames of a mesh are compared with: pairs by the oracle, contacts, or pairs within a distance, by the exact test of the host;
    /// at rank 0 only.
    struct Expected {
        std::optional<double> distance;
        PairList pairs = {}, contacts = {};
    };

    static Expected expected(const Mesh& mesh, bool keep_adjacent, std::optional<double> distance)
    {
        if (ranks->rank() != 0)
            return {distance};
        const WantedPairs wanted(mesh.faces, keep_adjacent, {}, Among::all);
        std::vector<Aabb> boxes = face_boxes(mesh.points, mesh.faces);
        for (Aabb& box : boxes)
            box = padded(box, reach_of(distance.value_or(0)));
        PairList pairs = swept_pairs(boxes, wanted);
        PairList contacts = chosen(pairs, [&](Pair pair) {
            return distance ? are_within(mesh.points, mesh.faces, pair,
                                         {.distance = *distance, .keep_adjacent = keep_adjacent})
                            : triangles_meet(mesh.points, mesh.faces, pair, keep_adjacent);
        });
        return {distance, std::move(pairs), std::move(contacts)};
    }

    /// Distributes the mesh, which every rank makes and the last one deals out, and compares a frame of each pipeline with the oracle's, of
    /// contacts and of pairs within a share of its length.
    static void hold_to_oracle(const Mesh& mesh, const std::string& name,
                               double share_of_length = 0.02)
    {
        const Aabb box = box_around(mesh.points, mesh.faces);
        const double length = double{box.max_x} - double{box.min_x};
        hold_frames(mesh, name, {});
        hold_frames(mesh, name + " within", share_of_length * length);
    }

    static void hold_frames(const Mesh& mesh, const std::string& name,
                            std::optional<double> distance)
    {
        const Expected wanted[] = {expected(mesh, false, distance), expected(mesh, true, distance)};
        const uint dealer = ranks->count() - 1;
        for (const PartitionBy by : {PartitionBy::rcb, PartitionBy::curve}) {
            if (distance && by == PartitionBy::rcb)
                continue;  // its parts overlap less
            Share share = dealt(mesh.points, mesh.faces, dealer, *ranks);
            const std::vector<Point> centres = box_centres(share);
            share =
                moved(share, partitioned({centres, share.ids}, by, ranks->count(), *ranks), *ranks);
            for (const PipelineChoice& pipeline : pipelines)
                expect_frame(wanted[pipeline.collider.keep_adjacent ? 1 : 0], share, pipeline,
                             name + ", " + std::string(partition_names[static_cast<int>(by)]) +
                                 ", " + pipeline.builder.name);
        }
    }

    static PairList at_first(std::vector<Pair> own)
    {
        std::vector<std::vector<Pair>> to(ranks->count());
        to[0] = std::move(own);
        std::vector<Pair> all;
        for (const std::vector<Pair>& from : exchanged(*ranks, to))
            all.insert(all.end(), from.begin(), from.end());
        return PairList(std::move(all));
    }

    static void expect_frame(const Expected& expected, const Share& share,
                             const PipelineChoice& pipeline, const std::string& name)
    {
        const auto builder = make_builder(pipeline.builder, bench().programs);
        const auto collider = make_collider(pipeline.collider, bench().programs);
        DistributedFrame frame(*ranks, bench().programs, bench().queue, *builder, *collider,
                               PairTest{.narrow = "exact",
                                        .distance = expected.distance,
                                        .keep_adjacent = pipeline.collider.keep_adjacent});
        frame.take(share);
        frame.run();
        const RankFrame facts = frame.run();
        const std::vector<Pair> own = frame.pairs(), meeting = frame.contacts();
        EXPECT_EQ(own.size(), facts.own_pairs + facts.halo_pairs) << name;
        EXPECT_EQ(meeting.size(), facts.contacts) << name;
        EXPECT_EQ(frame.facts(), facts_of(own)) << name;
        const PairList pairs = at_first(own), contacts = at_first(meeting);
        if (ranks->rank() != 0)
            return;
        EXPECT_EQ(pairs.surplus() + contacts.surplus(), 0u) << name;
        EXPECT_TRUE(pairs == expected.pairs) << name;
        EXPECT_TRUE(contacts == expected.contacts) << name;
    }
};

TEST_F(Frames, OfScenesHaveThePairsOfTheOracle)
{
    for (const char* name : {"torus:4000", "soup:3000", "grid:512", "hairball:1000", "n-body:3050"})
        hold_to_oracle(mesh_of(name), name);
}

TEST_F(Frames, OfRealMeshesHaveThePairsOfTheOracle)
{
    if (data_folder().empty())
        GTEST_SKIP() << "BVHBENCH_DATA names no folder";
    for (const char* name : {"bunny_69451", "unc_cloth_ball", "unc_nbody"}) {
        const Scene loaded = load_scene(name, {.data = data_folder()});
        hold_to_oracle({loaded.frames.back(), loaded.faces}, name, 0.001);
    }
}

TEST_F(Frames, OfHardMeshesHaveThePairsOfTheOracle)
{
    for (const HardInput& input : hard_inputs())
        hold_to_oracle(input.make(150), std::string(input.name));
}

TEST_F(Frames, OfFewTrianglesLeaveRanksEmpty)
{
    const HardInput& input = hard_inputs().front();
    for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 9u})
        hold_to_oracle(input.make(count), std::to_string(count) + " triangles");
    const Mesh closed = mesh_of("sphere:6");  // neighbours share vertices
    for (uint count = 1; count <= closed.faces.size(); ++count)
        hold_to_oracle({closed.points, {closed.faces.begin(), closed.faces.begin() + count}},
                       std::to_string(count) + " neighbours");
}

TEST_F(Frames, OfASphereInASphereHaveThePairsOfTheOracle)
{
    Mesh mesh = mesh_of("sphere:1000");
    const auto points = static_cast<uint>(mesh.points.size());
    const std::size_t faces = mesh.faces.size();
    for (uint k = 0; k < points; ++k)
        mesh.points.push_back(
            {0.98f * mesh.points[k].x, 0.98f * mesh.points[k].y, 0.98f * mesh.points[k].z});
    for (std::size_t k = 0; k < faces; ++k)
        mesh.faces.push_back(
            {mesh.faces[k].a + points, mesh.faces[k].b + points, mesh.faces[k].c + points});
    hold_to_oracle(mesh, "two spheres");
    // One rank has the inner sphere, the domain of another is all around it.
    Share share = dealt(mesh.points, mesh.faces, 0, *ranks);
    std::vector<uint> to;
    for (const uint id : share.ids)
        to.push_back((id < faces ? 0u : 1u) % ranks->count());
    share = moved(share, to, *ranks);
    const PipelineChoice& pipeline = pipelines.front();
    expect_frame(expected(mesh, pipeline.collider.keep_adjacent, 0.01), share, pipeline,
                 "a domain in another");
}

TEST_F(Frames, AreJudgedByListsOrByFactsAlone)
{
    Session session(CommonOptions{});
    ClusterTask task;
    task.scene = "torus:3000";
    task.pipeline = {{.name = "oibvh-multi"}, {.name = "leaf"}};
    task.samples = 1;
    task.share_devices = true;
    for (const bool gathers : {true, false}) {
        task.most_gathered = gathers ? 100000 : 10;
        const ClusterFound found = run_cluster(*ranks, session, task);
        if (ranks->rank() != 0)
            continue;
        EXPECT_EQ(found.result.check.verdict, Check::Verdict::agrees) << found.result.check.detail;
        EXPECT_EQ(found.result.check.pairs_hash.has_value(), gathers);
        EXPECT_EQ(found.pairs.size(), gathers ? found.result.pairs.count : 0u);
        EXPECT_GT(found.result.pairs.count, 10000u);
    }
}

}  // namespace
}  // namespace bvhbench
