// SPDX-License-Identifier: MIT
//
// cuBQL: four of its builders, its refit, and its query of a fixed box, which is called here for the box of every triangle.
#define CUBQL_GPU_BUILDER_IMPLEMENTATION 1
#include <cuBQL/bvh.h>  // before its builders, which need it whole

#include <cuBQL/builder/cuda/radix.h>
#include <cuBQL/builder/cuda/rebinMortonBuilder.h>
#include <cuBQL/traversal/fixedBoxQuery.h>

#include "cuda_method.cuh"
#include "tree_writer.h"

namespace {

using Bvh = cuBQL::BinaryBVH<float, 3>;

enum class Builder { radix, rebin_radix, spatial_median, sah };

// One triangle's box against the tree. Triangles are taken in the order of the leaves, so that neighbours walk alike.
struct BoxQuery {
    Bvh bvh;
    const cuBQL::box3f* boxes;

    template <class Add>
    __device__ void operator()(uint32_t k, const Add& add) const
    {
        const uint32_t own = bvh.primIDs[k];
        const cuBQL::box3f box = boxes[own];
        const auto* all = boxes;
        cuBQL::fixedBoxQuery::forEachPrim(
            [&](uint32_t other) {
                if (own < other && box.overlaps(all[other]))
                    add(own, other);
                return CUBQL_CONTINUE_TRAVERSAL;
            },
            bvh, box);
    }
};

template <Builder builder, int leaf>
class CuBql : public adapter::CudaMethod {
public:
    ~CuBql() override { forget_tree(); }

    bvhbench_tree tree() override
    {
        const auto nodes = adapter::downloaded(bvh_.nodes, bvh_.numNodes);
        const auto ids = adapter::downloaded(bvh_.primIDs, bvh_.numPrims);
        return writer_.written(0u, [&](uint32_t number) {
            const Bvh::Node& node = nodes[number];
            const auto& box = node.bounds;
            adapter::Spelled<uint32_t> spelled{{box.lower.x, box.lower.y, box.lower.z},
                                               {box.upper.x, box.upper.y, box.upper.z},
                                               {},
                                               {}};
            const auto first = static_cast<uint32_t>(node.admin.offset);
            if (node.admin.count > 0)
                spelled.triangles.assign(ids.begin() + first,
                                         ids.begin() + first + node.admin.count);
            else
                spelled.children = {first, first + 1};
            return spelled;
        });
    }

protected:
    void forget_tree() override
    {
        if (bvh_.nodes != nullptr)
            cuBQL::cuda::free(bvh_);
        bvh_ = {};
    }

    void make_tree() override
    {
        cuBQL::BuildConfig config;
        config.makeLeafThreshold = leaf;
        config.maxAllowedLeafSize = 8;
        const auto* all = boxes<cuBQL::box3f>();
        if constexpr (builder == Builder::radix)
            cuBQL::cuda::radixBuilder(bvh_, all, triangles(), config);
        else if constexpr (builder == Builder::rebin_radix)
            cuBQL::cuda::rebinRadixBuilder(bvh_, all, triangles(), config);
        else if constexpr (builder == Builder::sah)
            cuBQL::cuda::sahBuilder(bvh_, all, triangles(), config);
        else
            cuBQL::gpuBuilder(bvh_, all, triangles(), config);
    }

    void refit_tree() override { cuBQL::gpuBuilder_impl::refit(bvh_, boxes<cuBQL::box3f>()); }

    void find_pairs() override
    {
        find_pairs_by(BoxQuery{bvh_, boxes<cuBQL::box3f>()}, bvh_.numPrims);
    }

private:
    Bvh bvh_{};
    adapter::TreeWriter writer_;
};

template <Builder builder, int leaf>
bvhbench_method method(const char* name, const char* summary)
{
    return adapter::method<adapter::RefittedCudaCollider<CuBql<builder, leaf>>>(name, summary);
}

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {
        method<Builder::radix, 1>("cubql-radix",
                                  "radixBuilder, leaves of 1 triangle; fixedBoxQuery"),
        method<Builder::rebin_radix, 8>("cubql-rebin-radix",
                                        "rebinRadixBuilder, leaves of 8 triangles; fixedBoxQuery"),
        method<Builder::spatial_median, 1>(
            "cubql-spatial-median",
            "gpuBuilder with SPATIAL_MEDIAN, leaves of 1 triangle; fixedBoxQuery"),
        method<Builder::sah, 1>("cubql-sah", "sahBuilder, leaves of 1 triangle; fixedBoxQuery")};
    return adapter::plugin(host_abi, "cuBQL", LIBRARY_VERSION, "Apache-2.0", adapter::device_name(),
                           methods);
}
