// SPDX-License-Identifier: MIT
//
// High-Performance-BVH-Builder-In-CUDA (lottery7): H-PLOC over Morton codes of 32 bits. Its kernels are called as its experiment
// `run_hploc` calls them. It has no overlap query and no refit: the walk over its binary tree is ours.
#include "stack_walk.cuh"

#include <cub/device/device_radix_sort.cuh>

#include <kernels/helpers/helpers.cuh>
#include <kernels/hploc/hploc_bvh2.cuh>

namespace {

// What the builder counts up from: the box of all triangles, and how many nodes there are.
struct Start {
    AABB scene;
    unsigned int nodes;
};

class Lottery7 : public adapter::BinaryMethod {
protected:
    void reserve() override
    {
        BinaryMethod::reserve();
        const Start start{AABB::neutral(), triangles()};
        start_.allocate(1);
        start_.upload(&start);
        state_.allocate(1);
        nodes_.allocate(2ull * triangles() - 1);
        for (auto* array : {&codes_, &sorted_codes_, &leaves_, &sorted_leaves_, &parents_})
            array->allocate(triangles());
        size_t bytes = 0;
        sort(nullptr, bytes);
        for_sort_.allocate(bytes);
    }

    // The library makes the boxes itself, and with them leaves and the box of all.
    void find_boxes() override
    {
        adapter::check(
            cudaMemcpyAsync(state_.data(), start_.data(), sizeof(Start), cudaMemcpyDeviceToDevice),
            "start");
        cuda::hploc::build_leaves_kernel<<<blocks(3 * 128), 128>>>(
            faces(), triangles(), points(), nodes_.data(), leaves_.data(), &state_.data()->scene);
        adapter::check(cudaGetLastError(), "build_leaves_kernel");
    }

    void make_tree() override
    {
        adapter::check(cudaMemsetAsync(parents_.data(), 0xFF, sizeof(unsigned int) * triangles()),
                       "parents");
        cuda::compute_morton_codes_kernel<<<blocks(256), 256>>>(
            &state_.data()->scene, faces(), points(), codes_.data(), triangles());
        adapter::check(cudaGetLastError(), "compute_morton_codes_kernel");
        size_t bytes = for_sort_.size();
        sort(for_sort_.data(), bytes);
        cuda::hploc::build_kernel<<<blocks(64), 64>>>(parents_.data(), sorted_codes_.data(),
                                                      nodes_.data(), sorted_leaves_.data(),
                                                      &state_.data()->nodes, triangles());
        adapter::check(cudaGetLastError(), "build_kernel");
    }

    const adapter::BinaryNode* binary_nodes() const override { return as_binary(nodes_.data()); }

private:
    unsigned int blocks(unsigned int each) const { return (triangles() + each - 1) / each; }

    void sort(void* memory, size_t& bytes)
    {
        adapter::check(cub::DeviceRadixSort::SortPairs(memory, bytes, codes_.data(),
                                                       sorted_codes_.data(), leaves_.data(),
                                                       sorted_leaves_.data(), triangles(), 0, 32),
                       "sort");
    }

    adapter::DeviceArray<Start> start_, state_;
    adapter::DeviceArray<BVH2Node> nodes_;
    adapter::DeviceArray<unsigned int> codes_, sorted_codes_, leaves_, sorted_leaves_, parents_;
    adapter::DeviceArray<char> for_sort_;
};

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {adapter::method<adapter::CudaCollider<Lottery7>>(
        "lottery7-hploc",
        "H-PLOC over 32-bit Morton codes; a walk of this adapter finds the pairs")};
    return adapter::plugin(host_abi, "High-Performance-BVH-Builder-In-CUDA", LIBRARY_VERSION, "MIT",
                           adapter::device_name(), methods);
}
