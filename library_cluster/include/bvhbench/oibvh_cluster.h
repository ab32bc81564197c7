// SPDX-License-Identifier: MIT
//
// One scene on several devices: each rank of an MPI communicator has a part of the triangles and an OpenCL queue, and together the
// ranks find all pairs of triangles whose boxes overlap, each pair once.
//
//     bvhbench::oibvh::DistributedTree tree(MPI_COMM_WORLD, queue);
//     tree.distribute(bvhbench::oibvh::HostTriangles{points, faces}, 0);   // rank 0 has the mesh
//     tree.find_pairs();                                                   // builds the trees and finds the pairs
//     std::vector<bvhbench::oibvh::Pair> own = tree.read_pairs();          // those that this rank found
//
// docs/library.md is the guide, docs/cluster.md says how it works. Calls marked "All ranks" are collective: all ranks must make them,
// in the same order. If such a call fails on one rank, all ranks throw the same Error; "rank 2: " before its sentence names the
// rank, unless all ranks failed with this sentence. These calls throw nothing else.
#pragma once

#include <bvhbench/oibvh.h>
#include <mpi.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace bvhbench::oibvh {

/// How triangles are divided among the ranks, by the centres of their boxes. rcb: recursive bisection along the longest side, in
/// parts whose sizes differ by one triangle at most. curve: ranges of a Hilbert curve.
enum class Partition { rcb, curve };

/// Options of a rank. `partition`, `contacts`, `within`, `tree.adjacent_pairs` and `tree.check_input` must be the same on all ranks.
struct ClusterOptions {
    Options tree = {};          ///< builder, order, collider, pairs and checks, as of a Tree
    DeviceOptions device = {};  ///< of this rank's device
    Partition partition = Partition::rcb;
    /// Whether a frame also decides which of the pairs intersect: exactly, for the coordinates as stored (docs/contacts.md).
    bool contacts = false;
    /// If set, in the unit of the points: a frame decides in place of that which pairs are at most so far apart, as Tree::find_within does. It
    /// counts and reads them as contacts; `pairs` are then candidates, those of boxes with room for the distance.
    std::optional<double> within = {};
};

/// The part of a scene that a rank has before it is distributed; any number of triangles, none included. Each triangle and each vertex
/// has a number in the scene. Pairs name triangles by it; a vertex that several triangles share has one number on all ranks. Numbers of
/// vertices need not be consecutive, but take 1.5 bits of host memory each from the least to the greatest.
struct RankTriangles {
    std::span<const Point> points;
    std::span<const Face> faces;  ///< indices into `points`
    std::span<const std::uint32_t>
        triangles;  ///< number of each face in the scene, unique over all ranks
    std::span<const std::uint32_t> vertices;  ///< number of each point in the scene
};

/// What a frame found, and what this rank sent for it.
struct FrameCounts {
    std::uint64_t pairs = 0;  ///< found by this rank
    std::uint64_t contacts =
        0;  ///< those of them that were asked for; 0 without `contacts` or `within`
    std::uint64_t all_pairs = 0;     ///< found by all ranks
    std::uint64_t all_contacts = 0;  ///< the same of contacts
    std::uint64_t sent =
        0;  ///< triangles sent to other ranks, once for each rank that they went to
    std::uint64_t received = 0;  ///< triangles received from other ranks
    std::uint64_t sent_bytes = 0;
    /// Most work of a rank, divided by the mean; the same on all ranks. Work is counted in triangles and pairs.
    double imbalance = 1;
};

/// This rank's part of a scene that several devices work on. Runs on the caller's queue, as a Tree does. Calls on it are made from
/// one thread at a time, which MPI must allow to make calls of its own. Destroy it on all ranks, before MPI_Finalize if they go on
/// to use MPI. An error of MPI itself ends all ranks.
class BVHBENCH_API DistributedTree {
public:
    /// Takes the processes of `comm` as ranks: an intracommunicator, which is duplicated. All ranks. Throws BadInput for a null
    /// communicator or one between two groups, if MPI is not running, and for options that are unknown or differ; else as a Device and
    /// a Tree.
    DistributedTree(MPI_Comm comm, cl_command_queue queue, const ClusterOptions& options = {});
    DistributedTree(DistributedTree&& other) noexcept;
    DistributedTree& operator=(DistributedTree&& other) noexcept;
    ~DistributedTree();

    int rank() const;   ///< of this process, from 0 on
    int ranks() const;  ///< how many there are

    /// Divides the scene among the ranks, by `ClusterOptions::partition`, and reserves memory for frames over it. Each rank passes
    /// some triangles, in any order. Copies them. If several ranks pass a vertex, the point of the lowest of them counts. All
    /// ranks. Throws BadInput if there is no triangle, if the lengths of the arrays do not fit, and, with `check_input`, for an
    /// index out of range, a coordinate that is not finite or a number given to two triangles; the scene before stays. After any
    /// other Error there is no scene.
    void distribute(const RankTriangles& own);

    /// The same for a mesh that rank `root` has; the argument of other ranks is ignored. Triangles and vertices are numbered as in
    /// the mesh.
    void distribute(const HostTriangles& mesh, int root);

    // The calls from here on throw BadInput if there is no scene.

    /// Moves the vertices. `points`: where the points are that this rank passed to `distribute`, in the same order; of the mesh, at
    /// its root, and none elsewhere. Triangles stay on their ranks. All ranks. Throws BadInput for a wrong number of points or a
    /// coordinate that is not finite; the scene stays as it was. After any other Error there is no scene.
    void update(std::span<const Point> points);

    /// Runs a frame: builds each rank's tree anew and finds all pairs. All ranks. Throws Unavailable for more than 2^32 - 1 pairs on
    /// one rank or too little memory, and OpenClFailure; afterwards there is no scene.
    FrameCounts find_pairs();

    /// Returns the pairs that this rank found in the last frame, by numbers in the scene, the smaller first, in no order. Each pair
    /// of the scene is on one rank. Waits. Throws BadInput if there was no frame since the last `distribute`, `update` or
    /// `rebalance`, and any other Error.
    std::vector<Pair> read_pairs() const;

    /// Returns those of them that intersect, or are within the distance. Waits. Throws as `read_pairs`, and BadInput if neither was asked for.
    std::vector<Pair> read_contacts() const;

    /// Returns the pairs of all ranks on rank 0, sorted, and none elsewhere. All ranks. Throws as `read_pairs`.
    std::vector<Pair> gather_pairs() const;

    /// Returns the contacts of all ranks on rank 0, sorted, and none elsewhere. All ranks. Throws as `read_contacts`.
    std::vector<Pair> gather_contacts() const;

    /// Divides the scene anew, so that each rank has about as much work as the others by the pairs of the last frame: a triangle weighs
    /// 1, and 1 for each of its pairs. Worth it where `FrameCounts::imbalance` has grown. Returns how many triangles changed their rank.
    /// All ranks. Throws BadInput for another partition than rcb, or if there was no frame as in `read_pairs`. After any other
    /// Error there is no scene.
    std::uint64_t rebalance();

    /// Returns the numbers of the triangles that this rank has, ascending.
    std::vector<std::uint32_t> triangles() const;

    /// Returns the bytes of device memory that this rank holds.
    std::size_t memory() const;

    struct Impl;

private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace bvhbench::oibvh
