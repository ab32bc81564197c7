// SPDX-License-Identifier: MIT
//
// What one rank passes wrongly, or lacks memory for, all ranks refuse with the same sentence, and none waits for another.

#include "tests/library_cluster/rank_scene.h"

namespace bvhbench {
namespace {

using oibvh::BadInput;
using oibvh::ClusterOptions;
using oibvh::DistributedTree;

class ClusterLibraryRefuses : public testing::Test {
protected:
    static bool is_last() { return ranks->rank() + 1 == ranks->count(); }

    /// Returns the sentence of the last rank alone as all ranks throw it.
    static std::string of_last(const std::string& sentence)
    {
        return ranks->count() == 1 ? sentence
                                   : "rank " + std::to_string(ranks->count() - 1) + ": " + sentence;
    }

    /// Returns what a rank that passes `bad` is told; the other ranks pass what is right. Expects the scene to stay as it was.
    std::string refusal(const OwnTriangles& bad)
    {
        const std::string why =
            refusal_of<BadInput>([&] { tree.distribute((is_last() ? bad : own).view()); });
        expect_scene();
        return why;
    }

    void expect_scene()
    {
        tree.find_pairs();
        const auto pairs = tree.gather_pairs();
        if (ranks->rank() == 0) {
            EXPECT_EQ(pairs, pairs_of_one(caller, mesh, true));
        }
    }

    void SetUp() override { tree.distribute(own.view()); }

    Caller caller;
    LibraryMesh mesh = scene_mesh("torus:600");
    OwnTriangles own = scattered_part(mesh);
    DistributedTree tree{MPI_COMM_WORLD, caller.queue};
};

TEST_F(ClusterLibraryRefuses, TrianglesOfOneRankOnAllRanks)
{
    const std::string faces = std::to_string(own.faces.size()),
                      points = std::to_string(own.points.size());
    OwnTriangles bad = own;
    bad.faces[5].b = 70000;
    if (is_last()) {
        EXPECT_EQ(refusal(bad), of_last("triangle 5 names point 70000, and there are " + points));
    } else {
        EXPECT_TRUE(refusal(bad).starts_with(of_last("triangle 5 names point 70000")));
    }
    bad = own;
    bad.points[7].y = NAN;
    EXPECT_TRUE(refusal(bad).starts_with(of_last("point 7 is not finite: (")));
    bad = own;
    bad.triangles.pop_back();
    EXPECT_TRUE(refusal(bad).starts_with(of_last("there are ")));
    bad = own;
    bad.vertices.push_back(1);
    EXPECT_TRUE(refusal(bad).starts_with(of_last("there are ")));
}

TEST_F(ClusterLibraryRefuses, ANumberOfTwoTriangles)
{
    OwnTriangles bad = own;
    bad.triangles[3] = ranks->count() == 1 ? bad.triangles[4] : 0;  // rank 0 has triangle 0
    const std::uint32_t number = ranks->count() == 1 ? bad.triangles[4] : 0;
    EXPECT_EQ(refusal(bad), "two triangles have the number " + std::to_string(number));
}

TEST_F(ClusterLibraryRefuses, ASceneWithoutTriangles)
{
    const std::string why = "there are no triangles, and a tree has a leaf at least";
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.distribute(oibvh::RankTriangles{}); }), why);
    EXPECT_TRUE(
        refusal_of<BadInput>([&] { tree.distribute(oibvh::HostTriangles{}, 0); }).ends_with(why));
    expect_scene();
}

TEST_F(ClusterLibraryRefuses, ARootThatIsNotThereOrNotTheSame)
{
    const int count = tree.ranks();
    EXPECT_EQ(
        refusal_of<BadInput>([&] { tree.distribute(mesh.on_host(), count); }),
        "there is no rank " + std::to_string(count) + ", and there are " + std::to_string(count));
    EXPECT_THROW(tree.distribute(mesh.on_host(), -1), BadInput);
    if (count > 1) {
        EXPECT_EQ(refusal_of<BadInput>([&] { tree.distribute(mesh.on_host(), is_last() ? 1 : 0); }),
                  "`root` must be the same on all ranks, and is 0 on rank 0 and 1 on rank " +
                      std::to_string(count - 1));
    }
    expect_scene();
}

TEST_F(ClusterLibraryRefuses, PointsOfAnUpdate)
{
    std::vector<oibvh::Point> bad = own.points;
    bad[2].z = INFINITY;
    EXPECT_TRUE(refusal_of<BadInput>([&] {
                    tree.update(is_last() ? bad : own.points);
                }).starts_with(of_last("point 2 is not finite: (")));
    bad = own.points;
    bad.pop_back();
    EXPECT_TRUE(refusal_of<BadInput>([&] {
                    tree.update(is_last() ? bad : own.points);
                }).starts_with(of_last("there are ")));
    expect_scene();
}

TEST_F(ClusterLibraryRefuses, CallsBeforeTheirTime)
{
    DistributedTree empty(MPI_COMM_WORLD, caller.queue, {.partition = oibvh::Partition::curve});
    const std::string no_scene = " needs a scene, and none was distributed, or a call failed since",
                      no_frame =
                          " needs pairs, and there was no frame since the triangles last changed";
    EXPECT_EQ(refusal_of<BadInput>([&] { empty.find_pairs(); }), "a frame" + no_scene);
    EXPECT_EQ(refusal_of<BadInput>([&] { empty.update({}); }), "an update" + no_scene);
    EXPECT_EQ(refusal_of<BadInput>([&] { empty.read_pairs(); }), "reading pairs" + no_scene);
    EXPECT_EQ(refusal_of<BadInput>([&] { empty.triangles(); }), "the list of triangles" + no_scene);
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.read_pairs(); }), "reading pairs" + no_frame);
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.gather_pairs(); }), "gathering pairs" + no_frame);
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.rebalance(); }), "a rebalance" + no_frame);
    expect_scene();
    tree.update(own.points);
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.read_pairs(); }), "reading pairs" + no_frame);
    tree.find_pairs();
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.gather_contacts(); }),
              "there are no contacts to read, because `contacts` is off");
    empty.distribute(own.view());
    empty.find_pairs();
    EXPECT_EQ(refusal_of<BadInput>([&] { empty.rebalance(); }),
              "a rebalance cuts the scene by rcb, and its partition is curve");
}

TEST_F(ClusterLibraryRefuses, OptionsThatAreUnknownOrDiffer)
{
    const auto refused = [&](const ClusterOptions& options) {
        return refusal_of<BadInput>(
            [&] { DistributedTree(MPI_COMM_WORLD, caller.queue, options); });
    };
    ClusterOptions options;
    options.tree.order = "hilbret30";
    EXPECT_TRUE(refused(options).starts_with("no order is called 'hilbret30'"));
    options = {};
    options.partition = static_cast<oibvh::Partition>(7);
    EXPECT_EQ(refused(options), "a partition is rcb or curve, not 7");
    if (ranks->count() == 1)
        return;
    options = {.contacts = is_last()};
    EXPECT_EQ(refused(options),
              "`contacts` must be the same on all ranks, and is 0 on rank 0 and 1 on rank " +
                  std::to_string(ranks->count() - 1));
    options = {};
    if (is_last())
        options.tree.collider = "laef";
    EXPECT_TRUE(refused(options).starts_with(of_last("no collider of the library is called")));
}

TEST_F(ClusterLibraryRefuses, QueuesAndCommunicatorsThatAreNone)
{
    EXPECT_EQ(refusal_of<BadInput>(
                  [&] { DistributedTree(MPI_COMM_WORLD, is_last() ? nullptr : caller.queue); }),
              of_last("a Device wants a cl_command_queue, and it is null"));
    EXPECT_EQ(refusal_of<BadInput>([&] { DistributedTree(MPI_COMM_NULL, caller.queue); }),
              "a DistributedTree wants a communicator, and it is null");
    if (ranks->count() == 1)
        return;
    MPI_Comm half = MPI_COMM_NULL, both = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, ranks->rank() == 0 ? 0 : 1, 0, &half);
    MPI_Intercomm_create(half, 0, MPI_COMM_WORLD, ranks->rank() == 0 ? 1 : 0, 0, &both);
    EXPECT_EQ(refusal_of<BadInput>([&] { DistributedTree(both, caller.queue); }),
              "a DistributedTree wants the communicator of one group, and this one is between two");
    MPI_Comm_free(&both);
    MPI_Comm_free(&half);
}

/// Only the last rank has little memory. Too little for its triangles, then for its pairs only: all ranks say so, at once.
TEST_F(ClusterLibraryRefuses, TooLittleMemoryOfOneRankOnAllRanks)
{
    tree.find_pairs();
    const std::size_t all = tree.memory();
    LibraryMesh packed;  // many more pairs than lists have room for at first
    packed.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    packed.faces.assign(1200, {0, 1, 2});
    const OwnTriangles more = scattered_part(packed);
    const auto expect_frames = [&](std::size_t limit, bool fails_in_frame) {
        ClusterOptions options;
        if (is_last())
            options.device.memory_limit = limit;
        DistributedTree limited(MPI_COMM_WORLD, caller.queue, options);
        const auto why = refusal_of<oibvh::Unavailable>([&] {
            limited.distribute((fails_in_frame ? more : own).view());
            if (!fails_in_frame)
                ADD_FAILURE() << "memory sufficed";
            limited.find_pairs();
        });
        EXPECT_TRUE(ranks->count() == 1 || why.starts_with(of_last(""))) << why;
        EXPECT_EQ(refusal_of<BadInput>([&] { limited.find_pairs(); }),
                  "a frame needs a scene, and none was distributed, or a call failed since");
        if (!fails_in_frame)
            return;
        limited.distribute(own.view());  // works again
        limited.find_pairs();
        const auto pairs = limited.gather_pairs();
        if (ranks->rank() == 0) {
            EXPECT_EQ(pairs, pairs_of_one(caller, mesh, true));
        }
    };
    expect_frames(all / 4, false);
    expect_frames(all + all / 4, true);
}

}  // namespace
}  // namespace bvhbench
