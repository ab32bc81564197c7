// SPDX-License-Identifier: MIT
//
// Frames of the cluster's library have, over all ranks, the pairs of a Tree, list for list, and the contacts among them,
// however the triangles are passed.
#include "collide/narrow/narrow.h"
#include "tests/library_cluster/rank_scene.h"

namespace bvhbench {
namespace {

using oibvh::ClusterOptions;
using oibvh::DistributedTree;
using oibvh::FrameCounts;

/// Returns those of the pairs that intersect, by the exact test of the host.
std::vector<oibvh::Pair> contacts_of(const LibraryMesh& mesh, std::vector<oibvh::Pair> pairs,
                                     bool adjacent_pairs)
{
    const Mesh own = mesh.mesh();
    std::erase_if(pairs, [&](oibvh::Pair pair) {
        return !triangles_meet(own.points, own.faces, {pair.a, pair.b}, adjacent_pairs);
    });
    return pairs;
}

class ClusterLibrary : public testing::Test {
protected:
    static void SetUpTestSuite() { caller = std::make_unique<Caller>(); }
    static void TearDownTestSuite() { caller.reset(); }

    /// Runs a frame and compares it with that of one device.
    static FrameCounts expect_frame(DistributedTree& tree, const LibraryMesh& mesh,
                                    const ClusterOptions& options, const std::string& name)
    {
        const FrameCounts counts = tree.find_pairs();
        const std::vector<oibvh::Pair> own = tree.read_pairs(), pairs = tree.gather_pairs();
        EXPECT_EQ(counts.pairs, own.size()) << name;
        EXPECT_EQ(counts.all_pairs, sum_of_ranks(own.size())) << name;
        EXPECT_EQ(sum_of_ranks(counts.sent), sum_of_ranks(counts.received)) << name;
        EXPECT_EQ(pairs.size(), ranks->rank() == 0 ? counts.all_pairs : 0) << name;
        EXPECT_EQ(sum_of_ranks(tree.triangles().size()), mesh.faces.size()) << name;
        std::vector<oibvh::Pair> contacts;
        if (options.contacts) {
            contacts = tree.gather_contacts();
            EXPECT_EQ(counts.contacts, tree.read_contacts().size()) << name;
            EXPECT_EQ(counts.all_contacts, sum_of_ranks(counts.contacts)) << name;
        }
        if (ranks->rank() != 0)
            return counts;
        const auto right = pairs_of_one(*caller, mesh, options.tree.adjacent_pairs);
        EXPECT_EQ(pairs, right) << name;
        if (options.contacts) {
            EXPECT_EQ(contacts, contacts_of(mesh, right, options.tree.adjacent_pairs)) << name;
        }
        return counts;
    }

    /// Distributes the mesh in several ways and compares a frame of each with that of one device.
    static void expect_mesh(DistributedTree& tree, const LibraryMesh& mesh,
                            const ClusterOptions& options, const std::string& name)
    {
        const int last = tree.ranks() - 1;
        const LibraryMesh none;
        tree.distribute((tree.rank() == last ? mesh : none).on_host(), last);
        expect_frame(tree, mesh, options, name + " of the last rank");
        tree.distribute(scattered_part(mesh).view());
        expect_frame(tree, mesh, options, name + " of all ranks");
    }

    inline static std::unique_ptr<Caller> caller;
};

TEST_F(ClusterLibrary, HasThePairsOfATree)
{
    for (const auto partition : {oibvh::Partition::rcb, oibvh::Partition::curve})
        for (const bool adjacent_pairs : {false, true}) {
            const ClusterOptions options{.tree = {.adjacent_pairs = adjacent_pairs},
                                         .partition = partition,
                                         .contacts = true};
            DistributedTree tree(MPI_COMM_WORLD, caller->queue, options);
            for (const char* name : {"torus:3000", "soup:2000", "hairball:1000"})
                expect_mesh(tree, scene_mesh(name), options, name);
            // Few triangles leave ranks empty.
            const LibraryMesh closed = scene_mesh("sphere:6"), soup = soup_mesh(9);
            for (const LibraryMesh& whole : {closed, soup})
                for (std::size_t count = 1; count <= std::min<std::size_t>(9, whole.faces.size());
                     ++count) {
                    LibraryMesh mesh = whole;
                    mesh.faces.resize(count);
                    expect_mesh(tree, mesh, options, std::to_string(count) + " triangles");
                }
        }
}

TEST_F(ClusterLibrary, HasThePairsOfATreeWithAnyBuilderAndCollider)
{
    const LibraryMesh mesh = scene_mesh("torus:2000");
    const auto expect_frames = [&](const oibvh::Options& options) {
        DistributedTree tree(MPI_COMM_WORLD, caller->queue, {.tree = options});
        expect_mesh(tree, mesh, {.tree = options}, options.collider);
    };
    for (const char* collider : {"leaf", "group", "block", "bvtt"})
        expect_frames({.builder = "oibvh-multi", .order = "kd", .collider = collider});
    expect_frames({.sorted_leaves = false, .check_input = false});
}

TEST_F(ClusterLibrary, HasThePairsOfATreeOnAnyQueue)
{
    const LibraryMesh mesh = scene_mesh("torus:2000");
    for (const cl_command_queue_properties kind :
         {cl_command_queue_properties{CL_QUEUE_PROFILING_ENABLE},
          cl_command_queue_properties{CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE}}) {
        const Caller other(kind);
        DistributedTree tree(MPI_COMM_WORLD, other.queue, {.contacts = true});
        tree.distribute(scattered_part(mesh).view());
        expect_frame(tree, mesh, {.contacts = true}, std::to_string(kind));
    }
}

TEST_F(ClusterLibrary, HasThePairsThatATreeFindsWithinADistance)
{
    const LibraryMesh mesh = scene_mesh("soup:2000");
    for (const double distance : {0.0, 0.01, 0.1}) {
        DistributedTree tree(MPI_COMM_WORLD, caller->queue, {.within = distance});
        tree.distribute(scattered_part(mesh).view());
        const FrameCounts counts = tree.find_pairs();
        const auto right = pairs_of_one(*caller, mesh, true, distance);
        EXPECT_EQ(counts.all_contacts, right.size());
        EXPECT_EQ(tree.gather_contacts(), ranks->rank() == 0 ? right : std::vector<oibvh::Pair>());
    }
}

TEST_F(ClusterLibrary, FollowsPointsAndCutsAnew)
{
    const ClusterOptions options{.contacts = true};
    const LibraryMesh first = scene_mesh("torus:3000");
    // Half of the torus is pressed flat: the ranks of that half get more pairs.
    const auto pressed = [&](float share) {
        LibraryMesh mesh = first;
        for (oibvh::Point& point : mesh.points)
            if (point.x > 0)
                point.z *= 1 - share;
        return mesh;
    };
    for (const bool of_one_rank : {true, false}) {
        DistributedTree tree(MPI_COMM_WORLD, caller->queue, options);
        OwnTriangles own = scattered_part(first);
        if (of_one_rank)
            tree.distribute(first.on_host(), 0);
        else
            tree.distribute(own.view());
        const std::vector<std::uint32_t> kept = tree.triangles();
        const auto move_to = [&](const LibraryMesh& mesh) {
            own.move_to(mesh);
            if (!of_one_rank)
                tree.update(own.points);
            else if (tree.rank() == 0)
                tree.update(mesh.points);
            else
                tree.update({});
        };
        for (const float share : {0.3f, 1.0f}) {
            move_to(pressed(share));
            expect_frame(tree, pressed(share), options, "moved");
            EXPECT_EQ(tree.triangles(), kept);
        }
        const FrameCounts uneven = expect_frame(tree, pressed(1), options, "again");
        const std::uint64_t changed = tree.rebalance();
        const FrameCounts even = expect_frame(tree, pressed(1), options, "rebalanced");
        if (tree.ranks() > 1) {
            EXPECT_GT(uneven.imbalance, 1.1);
            EXPECT_LT(even.imbalance, uneven.imbalance);
            EXPECT_GT(changed, 0u);
            EXPECT_EQ(changed, sum_of_ranks(changed) / ranks->count());
        }
        move_to(first);
        expect_frame(tree, first, options, "moved back");
    }
}

TEST_F(ClusterLibrary, TakesTheLowestRanksPointWhereSeveralPassAVertex)
{
    const LibraryMesh mesh = scene_mesh("torus:2000");
    DistributedTree tree(MPI_COMM_WORLD, caller->queue);
    OwnTriangles own = {.points = mesh.points, .faces = {}, .triangles = {}, .vertices = {}};
    own.vertices.resize(mesh.points.size());
    std::iota(own.vertices.begin(), own.vertices.end(), 0u);
    for (std::uint32_t k = ranks->rank(); k < mesh.faces.size(); k += ranks->count()) {
        own.triangles.push_back(k);
        own.faces.push_back(mesh.faces[k]);
    }
    for (oibvh::Point& point : own.points)
        point.z += 100 * static_cast<float>(ranks->rank());
    tree.distribute(own.view());
    expect_frame(tree, mesh, {}, "distributed");
    tree.update(own.points);
    expect_frame(tree, mesh, {}, "updated");
}

TEST_F(ClusterLibrary, LeavesTheCallersObjectsAlone)
{
    const cl_uint before = caller->references();
    {
        DistributedTree tree(MPI_COMM_WORLD, caller->queue), other = std::move(tree);
        other.distribute(scattered_part(scene_mesh("torus:500")).view());
        other.find_pairs();
        EXPECT_GT(other.memory(), 0u);
    }
    EXPECT_EQ(caller->references(), before);
}

TEST_F(ClusterLibrary, TakesAnyCommunicator)
{
    const LibraryMesh mesh = scene_mesh("torus:2000");
    const auto right = pairs_of_one(*caller, mesh, true);
    MPI_Comm backwards = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, 0, -static_cast<int>(ranks->rank()), &backwards);
    {
        DistributedTree of_one(MPI_COMM_SELF, caller->queue);
        DistributedTree all(backwards, caller->queue);
        EXPECT_EQ(of_one.ranks(), 1);
        EXPECT_EQ(all.rank(), all.ranks() - 1 - static_cast<int>(ranks->rank()));
        // A message of the caller's own, on the way while the library talks.
        int got = -1, sent = static_cast<int>(ranks->rank());
        const int next = (all.rank() + 1) % all.ranks(),
                  last = (all.rank() + all.ranks() - 1) % all.ranks();
        MPI_Request requests[2];
        MPI_Irecv(&got, 1, MPI_INT, last, 0, backwards, &requests[0]);
        all.distribute(mesh.on_host(), 0);
        of_one.distribute(mesh.on_host(), 0);
        all.find_pairs();
        of_one.find_pairs();
        MPI_Isend(&sent, 1, MPI_INT, next, 0, backwards, &requests[1]);
        MPI_Waitall(2, requests, MPI_STATUSES_IGNORE);
        EXPECT_EQ(got, all.ranks() - 1 - last);
        EXPECT_EQ(of_one.gather_pairs(), right);
        const auto pairs = all.gather_pairs();
        EXPECT_EQ(pairs, all.rank() == 0 ? right : std::vector<oibvh::Pair>());
    }
    MPI_Comm_free(&backwards);
}

}  // namespace
}  // namespace bvhbench
