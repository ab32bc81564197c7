// SPDX-License-Identifier: MIT
//
// Scalable-CCD's broad phase: sweep and tiniest queue, or plain sweep and prune with the library's own switch
// SCALABLE_CCD_USE_CUDA_SAP; each is a library of its own.
#include "cuda_method.cuh"

#include <scalable_ccd/cuda/broad_phase/broad_phase.cuh>

#include <thrust/execution_policy.h>
#include <thrust/sort.h>

#include <algorithm>
#include <memory>

namespace {

namespace ccd = scalable_ccd::cuda;
static_assert(std::is_same_v<scalable_ccd::Scalar, float>);

/// Writes a box as the library's constructor from boxes of the host does: x apart, to be sorted by.
struct WriteSplit {
    ccd::Scalar2* along_x;
    ccd::MiniBox* rest;

    __device__ void operator()(uint32_t t, const adapter::Box& box) const
    {
        along_x[t] = {box.low[0], box.high[0]};
        // Boxes that share a vertex are no pair for the library: each has one of its own, three times.
        const int own = static_cast<int>(t);
        rest[t] = {{box.low[1], box.low[2]}, {box.high[1], box.high[2]}, {own, own, own}, own};
    }
};

class ScalableCcd : public adapter::CudaMethod {
protected:
    void reserve() override
    {
        boxes_->sorted_major_intervals.resize(triangles());
        boxes_->mini_boxes.resize(triangles());
    }

    void find_boxes() override
    {
        find_boxes_by(WriteSplit{thrust::raw_pointer_cast(boxes_->sorted_major_intervals.data()),
                                 thrust::raw_pointer_cast(boxes_->mini_boxes.data())});
    }

    // As the library's constructor sorts, which would take boxes from the host.
    void make_tree() override
    {
        auto& along_x = boxes_->sorted_major_intervals;
        thrust::sort_by_key(thrust::device, along_x.begin(), along_x.end(),
                            boxes_->mini_boxes.begin(), ccd::SortIntervals());
    }

    // The broad phase can be gone through once: it cannot be wound back, and build() only takes the boxes over.
    void find_pairs() override
    {
        ccd::BroadPhase broad(memory_);
        broad.build(boxes_);
        fit_memory();
        found_ = 0;
        while (!broad.is_complete()) {
            const auto& part = broad.detect_overlaps_partial();
            static_assert(sizeof(int2) == sizeof(uint2));
            if (found_ < room().room)
                adapter::check(
                    cudaMemcpyAsync(
                        room().pairs + found_, thrust::raw_pointer_cast(part.data()),
                        std::min<uint64_t>(part.size(), room().room - found_) * sizeof(int2),
                        cudaMemcpyDeviceToDevice),
                    "pairs");
            found_ += part.size();
        }
        adapter::check(cudaGetLastError(), "query");
    }

    uint64_t found() override { return found_; }

private:
    /// The library makes room for as many pairs as would fit into the device's memory with what its narrow phase needs, and sets
    /// it to zero in each query: gigabytes. It is told that a pair needs so much that there is room for ours.
    void fit_memory()
    {
        const size_t all = memory_->__getAllocatable();
        const uint64_t wanted = room().room + room().room / 8;
        memory_->per_overlap_memory_size =
            std::max<size_t>(3 * sizeof(int2), all / std::max<uint64_t>(wanted, 1));
    }

    std::shared_ptr<ccd::DeviceAABBs> boxes_ = std::make_shared<ccd::DeviceAABBs>();
    std::shared_ptr<ccd::MemoryHandler> memory_ = std::make_shared<ccd::MemoryHandler>();
    uint64_t found_ = 0;
};

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
#ifdef SCALABLE_CCD_USE_CUDA_SAP
    const char *name = "scalable-ccd-sap", *summary = "BroadPhase along x: sweep and prune";
#else
    const char *name = "scalable-ccd-stq", *summary = "BroadPhase along x: sweep and tiniest queue";
#endif
    static const bvhbench_method methods[] = {
        adapter::method<adapter::CudaCollider<ScalableCcd>>(name, summary)};
    return adapter::plugin(host_abi, "Scalable-CCD", LIBRARY_VERSION, "Apache-2.0",
                           adapter::device_name(), methods);
}
