// SPDX-License-Identifier: MIT
//
// libuipc: its tree without a stack whose nodes know bodies and contacts; it finds the pairs of a set itself.
#include "uipc_trees.cuh"

#include <collision_detection/info_stackless_bvh.h>

namespace {

using adapter::Aabb, adapter::view;
using uipc::IndexT;

struct Every {
    template <class Info>
    MUDA_GENERIC bool operator()(const Info&) const
    {
        return true;
    }
};

/// All triangles are of one body and of one kind of contact, so that nothing is left out.
class InfoStackless : public adapter::SelfQuery<uipc::backend::cuda::InfoStacklessBVH> {
protected:
    void reserve() override
    {
        zeros_.allocate(triangles());
        adapter::check(cudaMemset(zeros_.data(), 0, sizeof(IndexT) * triangles()), "bodies");
    }
    void make_tree() override
    {
        const auto zeros = view(zeros_.data(), triangles());
        bvh_.build(view(boxes<Aabb>(), triangles()), zeros, zeros);
    }
    void find_pairs() override { bvh_.detect({}, Every{}, Every{}, pairs_); }

private:
    adapter::DeviceArray<IndexT> zeros_;
};

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {adapter::method<adapter::CudaCollider<InfoStackless>>(
        "uipc-info-stackless", "InfoStacklessBVH, all triangles of one body: build and detect")};
    return adapter::plugin(host_abi, "libuipc", LIBRARY_VERSION, "Apache-2.0",
                           adapter::device_name(), methods);
}
