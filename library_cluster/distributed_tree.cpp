// SPDX-License-Identifier: MIT
#include "library_cluster/distributed_tree.h"

#include <array>
#include <numeric>
#include <string>

#include "cluster/rebalance.h"
#include "geometry/error.h"
#include "library/tree.h"
#include "library_cluster/input.h"
#include "library_cluster/together.h"

namespace bvhbench::oibvh {
namespace {

PartitionBy internal(Partition partition)
{
    switch (partition) {
        case Partition::rcb:
            return PartitionBy::rcb;
        case Partition::curve:
            return PartitionBy::curve;
    }
    throw BadUsage("a partition is rcb or curve, not " +
                   std::to_string(static_cast<int>(partition)));
}

/// Returns `comm` if its processes can be ranks.
MPI_Comm checked(MPI_Comm comm)
{
    int has_begun = 0, has_ended = 0, is_between_groups = 0;
    MPI_Initialized(&has_begun);
    MPI_Finalized(&has_ended);
    if (has_begun == 0 || has_ended != 0)
        throw BadInput("a DistributedTree wants MPI to run, and it was " +
                       std::string(has_begun == 0 ? "not initialized" : "finalized"));
    if (comm == MPI_COMM_NULL)
        throw BadInput("a DistributedTree wants a communicator, and it is null");
    MPI_Comm_test_inter(comm, &is_between_groups);
    if (is_between_groups != 0)
        throw BadInput(
            "a DistributedTree wants the communicator of one group, and this one is "
            "between two");
    return comm;
}

void require_same_options(const ClusterOptions& options, Ranks& ranks)
{
    require_same("`partition`", static_cast<int>(options.partition), ranks);
    require_same("`contacts`", options.contacts ? 1 : 0, ranks);
    require_same("`within`", options.within.value_or(-1), ranks);
    require_same("`adjacent_pairs`", options.tree.adjacent_pairs ? 1 : 0, ranks);
    require_same("`check_input`", options.tree.check_input ? 1 : 0, ranks);
}

void require_length(std::span<const Point> points, std::size_t wanted)
{
    if (points.size() != wanted)
        throw BadUsage("there are " + std::to_string(points.size()) +
                       " points, and this rank passed " + std::to_string(wanted));
}

}  // namespace

DistributedTree::Impl::Part::Part(Impl& impl)
    : builder(make_builder(*impl.device, impl.options.tree))
    , collider(
          collider_for(impl.device->device, impl.options.tree.collider)
              .make(impl.device->programs, {.keep_adjacent = impl.options.tree.adjacent_pairs}))
    , frame(impl.ranks, impl.device->programs, impl.device->queue, *builder, *collider,
            PairTest{.narrow = impl.options.contacts && !impl.options.within ? "exact" : "none",
                     .distance = impl.options.within,
                     .keep_adjacent = impl.options.tree.adjacent_pairs})
{}

DistributedTree::Impl::Impl(MPI_Comm comm, cl_command_queue queue, const ClusterOptions& asked)
    : processes(ranks_of(checked(comm))), ranks(*processes), options(asked)
{
    together(ranks, [&] {
        internal(options.partition);
        device.emplace(oibvh::checked(queue), options.device);
        require_same_options(options, ranks);
        Part(*this);  // throws for options that are unknown
    });
}

void DistributedTree::Impl::together_or(const std::function<void()>& work, bool drops)
{
    try {
        together(ranks, [&] {
            device->queue.forget();
            device->queue.join();
            work();
        });
    } catch (...) {
        if (drops)
            part.reset();
        throw;
    }
}

void DistributedTree::Impl::distribute(Share own, std::vector<uint> vertices,
                                       std::span<const bvhbench::Point> points)
{
    part.reset();
    given = std::move(vertices);
    Share share = cut(std::move(own), internal(options.partition), {}, ranks).share;
    routes = PointRoutes(given, share, ranks);
    share.points = routes.sent(points, ranks);
    take(std::move(share));
}

void DistributedTree::Impl::take(Share share)
{
    has_frame = false;
    part = std::make_unique<Part>(*this);
    part->frame.take(std::move(share));
}

void DistributedTree::Impl::require_scene(const char* what) const
{
    if (part == nullptr)
        throw BadUsage(std::string(what) +
                       " needs a scene, and none was distributed, or a call failed since");
}

void DistributedTree::Impl::require_frame(const char* what) const
{
    require_scene(what);
    if (!has_frame)
        throw BadUsage(std::string(what) +
                       " needs pairs, and there was no frame since the triangles last changed");
}

void DistributedTree::Impl::require_contacts() const
{
    require_frame("reading contacts");
    if (!options.contacts && !options.within)
        throw BadUsage("there are no contacts to read, because `contacts` is off");
}

std::vector<Pair> DistributedTree::Impl::pairs(bool are_contacts)
{
    std::vector<Pair> all;
    for (const bvhbench::Pair pair : are_contacts ? part->frame.contacts() : part->frame.pairs())
        all.push_back({pair.a, pair.b});
    return all;
}

DistributedTree::DistributedTree(MPI_Comm comm, cl_command_queue queue,
                                 const ClusterOptions& options)
    : impl_(std::make_unique<Impl>(comm, queue, options))
{}
DistributedTree::DistributedTree(DistributedTree&& other) noexcept = default;
DistributedTree& DistributedTree::operator=(DistributedTree&& other) noexcept
{
    std::swap(impl_, other.impl_);
    return *this;
}
DistributedTree::~DistributedTree() = default;

int DistributedTree::rank() const { return static_cast<int>(impl_->ranks.rank()); }
int DistributedTree::ranks() const { return static_cast<int>(impl_->ranks.count()); }

void DistributedTree::distribute(const RankTriangles& own)
{
    impl_->check([&, &impl = *impl_] {
        require_numbers(own);
        require_count(own.faces.size(), impl.ranks);
        if (!impl.options.tree.check_input)
            return;
        require_corners(own.faces, own.points.size());
        require_finite(own.points);
        require_unique(own.triangles, impl.ranks);
    });
    impl_->change([&, &impl = *impl_] {
        impl.distribute(share_of(own), {own.vertices.begin(), own.vertices.end()},
                        own_points(own.points));
    });
}

void DistributedTree::distribute(const HostTriangles& mesh, int root)
{
    const bool is_root = root == rank();
    const HostTriangles own = is_root ? mesh : HostTriangles{};
    impl_->check([&, &impl = *impl_] {
        if (root < 0 || root >= ranks())
            throw BadUsage("there is no rank " + std::to_string(root) + ", and there are " +
                           std::to_string(ranks()));
        require_same("`root`", root, impl.ranks);
        require_count(own.faces.size(), impl.ranks);
        if (!impl.options.tree.check_input)
            return;
        require_corners(own.faces, own.points.size());
        require_finite(own.points);
    });
    impl_->change([&, &impl = *impl_] {
        std::vector<uint> vertices(own.points.size());
        std::iota(vertices.begin(), vertices.end(), 0u);
        const std::vector<bvhbench::Point> points = own_points(own.points);
        impl.distribute(dealt(points, own_faces(own.faces), static_cast<uint>(root), impl.ranks),
                        std::move(vertices), points);
    });
}

void DistributedTree::update(std::span<const Point> points)
{
    impl_->check([&, &impl = *impl_] {
        impl.require_scene("an update");
        require_length(points, impl.given.size());
        if (impl.options.tree.check_input)
            require_finite(points);
    });
    impl_->change([&, &impl = *impl_] {
        impl.has_frame = false;
        impl.part->frame.move(impl.routes.sent(own_points(points), impl.ranks));
    });
}

FrameCounts DistributedTree::find_pairs()
{
    impl_->check([&] { impl_->require_scene("a frame"); });
    FrameCounts counts;
    impl_->change([&, &impl = *impl_] {
        impl.has_frame = false;
        const RankFrame frame = impl.part->frame.run();
        counts.pairs = frame.own_pairs + frame.halo_pairs;
        counts.contacts = frame.contacts;
        counts.sent = frame.halo_sent;
        counts.received = frame.halo_received;
        counts.sent_bytes = frame.sent_bytes;
        std::array<std::uint64_t, 2> all{counts.pairs, counts.contacts};
        impl.ranks.sum(all);
        counts.all_pairs = all[0];
        counts.all_contacts = all[1];
        counts.imbalance =
            imbalance_of(impl.part->frame.share().triangle_count() + counts.pairs, impl.ranks);
        impl.has_frame = true;
    });
    return counts;
}

std::vector<Pair> DistributedTree::read_pairs() const
{
    try {
        impl_->require_frame("reading pairs");
        return impl_->pairs(false);
    } catch (...) {
        rethrow_as_error();
    }
}

std::vector<Pair> DistributedTree::read_contacts() const
{
    try {
        impl_->require_contacts();
        return impl_->pairs(true);
    } catch (...) {
        rethrow_as_error();
    }
}

std::vector<Pair> DistributedTree::gather_pairs() const
{
    std::vector<Pair> all;
    impl_->check([&, &impl = *impl_] {
        impl.require_frame("gathering pairs");
        all = all_at_first(impl.ranks, impl.pairs(false));
        std::ranges::sort(all);
    });
    return all;
}

std::vector<Pair> DistributedTree::gather_contacts() const
{
    std::vector<Pair> all;
    impl_->check([&, &impl = *impl_] {
        impl.require_contacts();
        all = all_at_first(impl.ranks, impl.pairs(true));
        std::ranges::sort(all);
    });
    return all;
}

std::uint64_t DistributedTree::rebalance()
{
    impl_->check([&, &impl = *impl_] {
        impl.require_frame("a rebalance");
        if (impl.options.partition != Partition::rcb)
            throw BadUsage("a rebalance cuts the scene by rcb, and its partition is curve");
    });
    std::uint64_t changed = 0;
    impl_->change([&, &impl = *impl_] {
        Share share = impl.part->frame.share();
        const std::vector<uint> work = work_of(share, impl.part->frame.pairs());
        impl.part.reset();
        Cut next = cut(std::move(share), PartitionBy::rcb, work, impl.ranks);
        impl.routes = PointRoutes(impl.given, next.share, impl.ranks);
        impl.take(std::move(next.share));
        std::array<std::uint64_t, 1> left{next.left};
        impl.ranks.sum(left);
        changed = left[0];
    });
    return changed;
}

std::vector<std::uint32_t> DistributedTree::triangles() const
{
    try {
        impl_->require_scene("the list of triangles");
    } catch (...) {
        rethrow_as_error();
    }
    return impl_->part->frame.share().ids;
}

std::size_t DistributedTree::memory() const { return *impl_->device->device.taken; }

}  // namespace bvhbench::oibvh
