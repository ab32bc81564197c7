// SPDX-License-Identifier: MIT
//
// libuipc: its tree without a stack, which finds the pairs of a set itself, and its linear BVH, which is asked here with the box
// of every triangle.
#include "tree_writer.h"
#include "uipc_trees.cuh"

#include <collision_detection/linear_bvh.h>
#include <collision_detection/stackless_bvh.h>

namespace {

namespace uipc_cuda = uipc::backend::cuda;
using adapter::Aabb, adapter::view;

class Stackless : public adapter::SelfQuery<uipc_cuda::StacklessBVH> {
protected:
    void make_tree() override { bvh_.build(view(boxes<Aabb>(), triangles())); }
    void find_pairs() override
    {
        bvh_.detect(uipc_cuda::StacklessBVH::DefaultQueryCallback{}, pairs_);
    }
};

// One triangle's box against the tree. Triangles are taken in the order of the leaves, so that neighbours walk alike.
struct BoxQuery {
    uipc_cuda::LinearBVHViewer bvh;
    const uipc_cuda::LinearBVHNode* leaves;
    const Aabb* boxes;

    template <class Add>
    __device__ void operator()(uint32_t k, const Add& add) const
    {
        const uint32_t own = leaves[k].object_idx;
        bvh.query(boxes[own], [&](uint32_t other) {
            if (own < other)
                add(own, other);
        });
    }
};

class Linear : public adapter::CudaMethod {
public:
    bvhbench_tree tree() override
    {
        const uipc_cuda::LinearBVHVisitor visitor(bvh_);
        const auto nodes = adapter::downloaded(visitor.nodes().data(), visitor.nodes().size());
        const auto all = adapter::downloaded(visitor.aabbs().data(), visitor.aabbs().size());
        return writer_.written(0u, [&](uint32_t number) {
            const auto &low = all[number].min(), &high = all[number].max();
            adapter::Spelled<uint32_t> spelled{
                {low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}, {}, {}};
            const uipc_cuda::LinearBVHNode& node = nodes[number];
            if (node.is_leaf())
                spelled.triangles = {node.object_idx};
            else
                spelled.children = {node.left_idx, node.right_idx};
            return spelled;
        });
    }

protected:
    void make_tree() override { bvh_.build(view(boxes<Aabb>(), triangles())); }
    void refit_tree() override { bvh_.update(view(boxes<Aabb>(), triangles())); }
    void find_pairs() override
    {
        const uipc_cuda::LinearBVHVisitor visitor(bvh_);
        find_pairs_by(BoxQuery{bvh_.viewer(), visitor.object_nodes().data(), boxes<Aabb>()},
                      triangles());
    }

private:
    uipc_cuda::LinearBVH bvh_;
    adapter::TreeWriter writer_;
};

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {
        adapter::method<adapter::CudaCollider<Stackless>>("uipc-stackless",
                                                          "StacklessBVH: build and detect"),
        adapter::method<adapter::RefittedCudaCollider<Linear>>(
            "uipc-linear", "LinearBVH: build, update and query")};
    return adapter::plugin(host_abi, "libuipc", LIBRARY_VERSION, "Apache-2.0",
                           adapter::device_name(), methods);
}
