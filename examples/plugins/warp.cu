// SPDX-License-Identifier: MIT
//
// Warp: the LBVH of its native library, its refit and its query of a box. Warp's Python runtime is not there:
// warp_runtime.cuh stands for it.
#include "cuda_method.cuh"
#include "tree_writer.h"

// The query keeps its stack in shared memory, with room for this many threads.
#define WP_TILE_BLOCK_DIM 128
#include <warp.h>

#include <bvh.h>
#include <cuda_util.h>

#include "warp_runtime.cuh"

namespace {

static_assert(WP_TILE_BLOCK_DIM == adapter::query_threads);

struct WriteCorners {
    wp::vec3 *lows, *highs;

    __device__ void operator()(uint32_t t, const adapter::Box& box) const
    {
        lows[t] = wp::vec3(box.low[0], box.low[1], box.low[2]);
        highs[t] = wp::vec3(box.high[0], box.high[1], box.high[2]);
    }
};

// One triangle's box against the tree. Triangles are taken in the order of the leaves, so that neighbours walk alike.
struct BoxQuery {
    const wp::BVH* bvh;
    const int* ids;
    const wp::vec3 *lows, *highs;

    template <class Add>
    __device__ void operator()(uint32_t k, const Add& add) const
    {
        const int own = ids[k];
        wp::bvh_query_t query =
            wp::bvh_query_aabb(reinterpret_cast<uint64_t>(bvh), lows[own], highs[own], -1);
        for (int other; wp::bvh_query_next(query, other, FLT_MAX);)
            if (own < other)
                add(own, other);
    }
};

class Warp : public adapter::CudaMethod {
public:
    ~Warp() override { forget_tree(); }

    bvhbench_tree tree() override
    {
        const auto lows = adapter::downloaded(bvh_.node_lowers, bvh_.max_nodes);
        const auto highs = adapter::downloaded(bvh_.node_uppers, bvh_.max_nodes);
        const auto ids = adapter::downloaded(bvh_.primitive_indices, bvh_.num_items);
        const int root = adapter::downloaded(bvh_.root, 1)[0];
        return writer_.written(static_cast<uint32_t>(root), [&](uint32_t number) {
            const auto &low = lows[number], &high = highs[number];
            adapter::Spelled<uint32_t> spelled{
                {low.x, low.y, low.z}, {high.x, high.y, high.z}, {}, {}};
            if (low.b)
                spelled.triangles.assign(ids.begin() + low.i, ids.begin() + high.i);
            else
                spelled.children = {low.i, high.i};
            return spelled;
        });
    }

protected:
    void reserve() override
    {
        lows_.allocate(triangles());
        highs_.allocate(triangles());
        on_device_.allocate(1);
    }

    void find_boxes() override { find_boxes_by(WriteCorners{lows_.data(), highs_.data()}); }

    void forget_tree() override
    {
        if (bvh_.node_lowers != nullptr)
            wp::bvh_destroy_device(bvh_);
        bvh_ = {};
    }

    void make_tree() override
    {
        constexpr int leaf = 1;
        wp::bvh_create_device(nullptr, lows_.data(), highs_.data(), static_cast<int>(triangles()),
                              BVH_CONSTRUCTOR_LBVH, nullptr, leaf, bvh_);
        on_device_.upload(&bvh_);
    }

    void refit_tree() override { wp::bvh_refit_device(bvh_); }

    void find_pairs() override
    {
        find_pairs_by(
            BoxQuery{on_device_.data(), bvh_.primitive_indices, lows_.data(), highs_.data()},
            triangles());
    }

private:
    adapter::DeviceArray<wp::vec3> lows_, highs_;
    adapter::DeviceArray<wp::BVH> on_device_;
    wp::BVH bvh_{};
    adapter::TreeWriter writer_;
};

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {adapter::method<adapter::RefittedCudaCollider<Warp>>(
        "warp-lbvh", "bvh_create_device with LBVH, leaves of 1 triangle; bvh_query_aabb")};
    return adapter::plugin(host_abi, "Warp", LIBRARY_VERSION, "Apache-2.0", adapter::device_name(),
                           methods);
}
