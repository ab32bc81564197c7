// SPDX-License-Identifier: MIT
//
// NexusBVH: H-PLOC over Morton codes of 32 or 64 bits. The library has no overlap query and no refit: the walk over its binary
// tree is ours.
#include "stack_walk.cuh"

#include <NXB/BVHBuilder.h>

namespace {

template <bool short_codes>
class Nexus : public adapter::BinaryMethod {
public:
    ~Nexus() override { forget_tree(); }

protected:
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

    const adapter::BinaryNode* binary_nodes() const override { return as_binary(bvh_.nodes); }

private:
    NXB::BVH2 bvh_{};
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
