// SPDX-License-Identifier: MIT
//
// NexusBVH: H-PLOC over Morton codes of 32 or 64 bits. The library has no overlap query and no refit: the walk over its binary
// tree is ours.
#include "cuda_method.cuh"
#include "tree_writer.h"

#include <NXB/BVHBuilder.h>

namespace {

using Node = NXB::BVH2::Node;

__device__ bool overlap(const NXB::AABB& a, const NXB::AABB& b)
{
    return a.bMin.x <= b.bMax.x && b.bMin.x <= a.bMax.x && a.bMin.y <= b.bMax.y &&
           b.bMin.y <= a.bMax.y && a.bMin.z <= b.bMax.z && b.bMin.z <= a.bMax.z;
}

// One triangle's box against the tree. Node k < triangles is the leaf of triangle k, the last node is the root.
struct Walk {
    const Node* nodes;
    uint32_t root;
    uint32_t* depth_exceeded;

    template <class Add>
    __device__ void operator()(uint32_t own, const Add& add) const
    {
        constexpr int most = 128;
        uint32_t waiting[most];
        int count = 0;
        const NXB::AABB box = nodes[own].bounds;
        uint32_t at = root;
        for (;;) {
            const Node node = nodes[at];
            uint32_t next[2];
            int found = 0;
            for (const uint32_t child : {node.leftChild, node.rightChild}) {
                const Node& below = nodes[child];
                if (!overlap(box, below.bounds))
                    continue;
                if (below.leftChild != INVALID_IDX)
                    next[found++] = child;
                else if (own < below.rightChild)
                    add(own, below.rightChild);
            }
            if (found == 2) {
                if (count == most) {
                    *depth_exceeded = 1;
                    return;
                }
                waiting[count++] = next[1];
            }
            if (found > 0)
                at = next[0];
            else if (count > 0)
                at = waiting[--count];
            else
                return;
        }
    }
};

template <bool short_codes>
class Nexus : public adapter::CudaMethod {
public:
    ~Nexus() override { forget_tree(); }

    bvhbench_tree tree() override
    {
        const auto nodes = adapter::downloaded(bvh_.nodes, bvh_.nodeCount);
        return writer_.written(bvh_.nodeCount - 1, [&](uint32_t number) {
            const Node& node = nodes[number];
            const NXB::AABB& box = node.bounds;
            adapter::Spelled<uint32_t> spelled{
                {box.bMin.x, box.bMin.y, box.bMin.z}, {box.bMax.x, box.bMax.y, box.bMax.z}, {}, {}};
            if (node.leftChild == INVALID_IDX)
                spelled.triangles = {node.rightChild};
            else
                spelled.children = {node.leftChild, node.rightChild};
            return spelled;
        });
    }

protected:
    void reserve() override
    {
        depth_exceeded_.allocate(1);
        const uint32_t no = 0;
        depth_exceeded_.upload(&no);
    }

    void forget_tree() override
    {
        if (bvh_.nodes != nullptr)
            NXB::FreeDeviceBVH(bvh_);
        bvh_ = {};
    }

    void make_tree() override
    {
        NXB::BuildConfig config;
        config.prioritizeSpeed = short_codes;
        bvh_ = NXB::BuildBVH2(boxes<NXB::AABB>(), triangles(), config);
    }

    void find_pairs() override
    {
        find_pairs_by(Walk{bvh_.nodes, bvh_.nodeCount - 1, depth_exceeded_.data()}, triangles());
    }

    uint64_t found() override
    {
        if (adapter::downloaded(depth_exceeded_.data(), 1)[0] != 0)
            throw std::runtime_error(
                "the tree is deeper than the 128 levels that the walk's stack has");
        return CudaMethod::found();
    }

private:
    NXB::BVH2 bvh_{};
    adapter::DeviceArray<uint32_t> depth_exceeded_;
    adapter::TreeWriter writer_;
};

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {
        adapter::method<adapter::CudaCollider<Nexus<true>>>(
            "nexus-hploc-32",
            "H-PLOC over 32-bit Morton codes; a walk of this adapter finds the pairs"),
        adapter::method<adapter::CudaCollider<Nexus<false>>>(
            "nexus-hploc-64",
            "H-PLOC over 64-bit Morton codes; a walk of this adapter finds the pairs")};
    return adapter::plugin(host_abi, "NexusBVH", LIBRARY_VERSION, "Apache-2.0",
                           adapter::device_name(), methods);
}
