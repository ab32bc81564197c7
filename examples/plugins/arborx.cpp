// SPDX-License-Identifier: MIT
//
// ArborX: its BVH on the execution space that Kokkos was built for, and its half traversal, which visits each pair once.
#include <ArborX.hpp>
#include <Kokkos_Core.hpp>
#include <detail/ArborX_HalfTraversal.hpp>

#include "tree_writer.h"

#ifdef KOKKOS_ENABLE_CUDA
#include "cuda_method.cuh"
#else
#include "host_method.h"
#endif

#include <optional>

namespace {

using Space = Kokkos::DefaultExecutionSpace;
using Box = ArborX::Box<3>;
using Value = ArborX::PairValueIndex<Box>;
using Bvh = ArborX::BoundingVolumeHierarchy<Space::memory_space, Value>;

struct BoxOf {
    KOKKOS_FUNCTION auto operator()(const Value& leaf) const
    {
        return ArborX::intersects(leaf.value);
    }
};

#ifdef KOKKOS_ENABLE_CUDA

using Method = adapter::CudaMethod;

struct Append {
    adapter::PairRoom room;

    __device__ void operator()(const Value& a, const Value& b) const
    {
        const unsigned long long at = atomicAdd(room.count, 1ull);
        if (at < room.room)
            room.pairs[at] = make_uint2(a.index, b.index);
    }
};

#else

using Method = adapter::HostMethod;

#endif

class Arbor : public Method {
protected:
    void make_tree() override
    {
        bvh_ = Bvh(space(), ArborX::Experimental::attach_indices(library_boxes()));
        space().fence();
    }

#ifdef KOKKOS_ENABLE_CUDA
    Kokkos::View<Box*, Space::memory_space, Kokkos::MemoryUnmanaged> library_boxes() const
    {
        return {boxes<Box>(), triangles()};
    }

    void find_pairs() override { traverse(Append{room()}); }
#else
    Kokkos::View<const Box*, Space::memory_space, Kokkos::MemoryUnmanaged> library_boxes() const
    {
        static_assert(sizeof(Box) == sizeof(adapter::Box),
                      "six floats: the least x, y, z, then the greatest");
        return {reinterpret_cast<const Box*>(boxes().data()), triangles()};
    }

    void find_pairs() override
    {
        traverse([this](const Value& a, const Value& b) {
            add(static_cast<unsigned>(Space::impl_hardware_thread_id()), a.index, b.index);
        });
    }

    uint64_t tree_bytes() const override
    {
        return triangles() * (sizeof(ArborX::Details::LeafNode<Value>) +
                              sizeof(ArborX::Details::InternalNode<Box>));
    }

public:
    bvhbench_tree tree() override
    {
        using Friends = ArborX::Details::HappyTreeFriends;
        return writer_.written(triangles() > 1 ? Friends::getRoot(bvh_) : 0, [this](int number) {
            const bool is_leaf = triangles() == 1 || Friends::isLeaf(bvh_, number);
            const Box box = is_leaf ? Friends::getValue(bvh_, number).value
                                    : Friends::getInternalBoundingVolume(bvh_, number);
            const auto &low = box.minCorner(), &high = box.maxCorner();
            adapter::Spelled<int> spelled{
                {low[0], low[1], low[2]}, {high[0], high[1], high[2]}, {}, {}};
            if (is_leaf)
                spelled.triangles = {Friends::getValue(bvh_, number).index};
            else
                spelled.children = {Friends::getLeftChild(bvh_, number),
                                    Friends::getRightChild(bvh_, number)};
            return spelled;
        });
    }

private:
    adapter::TreeWriter writer_;
#endif

private:
    /// Kokkos is started by the first method and lasts as long as the process.
    const Space& space()
    {
        if (!Kokkos::is_initialized())
            Kokkos::initialize();
        if (!space_)
            space_.emplace();
        return *space_;
    }

    template <class Callback>
    void traverse(const Callback& callback)
    {
        ArborX::Details::HalfTraversal<Bvh, Callback, BoxOf>(space(), bvh_, callback, BoxOf{});
        space().fence();
    }

    std::optional<Space> space_;
    Bvh bvh_;
};

#ifdef KOKKOS_ENABLE_CUDA
using Collider = adapter::CudaCollider<Arbor>;
#else
using Collider = adapter::HostCollider<Arbor>;
#endif

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {adapter::method<Collider>(
        "arborx", "BoundingVolumeHierarchy with 64-bit Morton codes; HalfTraversal")};
#ifdef KOKKOS_ENABLE_CUDA
    const std::string device = adapter::device_name();
#else
    const std::string device = "host";
#endif
    return adapter::plugin(host_abi, "ArborX", LIBRARY_VERSION, "BSD-3-Clause", device, methods);
}
