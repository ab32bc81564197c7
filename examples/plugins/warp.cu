// SPDX-License-Identifier: MIT
//
// Warp: the LBVH of its native library, its refit and its query of a box. Warp's Python runtime is not there: the functions of
// it that the library calls are at the end of this file, on the default stream.
#include "cuda_method.cuh"
#include "tree_writer.h"

// The query keeps its stack in shared memory, with room for this many threads.
#define WP_TILE_BLOCK_DIM 128
#include <warp.h>

#include <bvh.h>
#include <cuda_util.h>
#include <cub/cub.cuh>

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

[[noreturn]] void not_here(const char* what)
{
    throw std::runtime_error(std::string("Warp asked for ") + what +
                             ", which this adapter does not have");
}

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {adapter::method<adapter::RefittedCudaCollider<Warp>>(
        "warp-lbvh", "bvh_create_device with LBVH, leaves of 1 triangle; bvh_query_aabb")};
    static const std::string device = adapter::device_name();
    static const bvhbench_plugin plugin{BVHBENCH_PLUGIN_ABI, "Warp", LIBRARY_VERSION, "Apache-2.0",
                                        device.c_str(),      1,      methods};
    return host_abi == BVHBENCH_PLUGIN_ABI ? &plugin : nullptr;
}

// ---- Warp's runtime, as far as building and refitting an LBVH needs it. Memory comes from the device's pool, as Warp's does.

using adapter::check;

bool ContextGuard::always_restore = false;
CudaTimingState* g_cuda_timing_state = nullptr;

CUcontext get_current_context() { return nullptr; }
CUresult cuCtxGetCurrent_f(CUcontext*) { not_here("a context"); }
CUresult cuCtxSetCurrent_f(CUcontext) { not_here("a context"); }
CUresult cuEventCreate_f(CUevent*, unsigned) { not_here("an event"); }
CUresult cuEventRecord_f(CUevent, CUstream) { not_here("an event"); }
bool check_cu_result(CUresult result, const char* function, const char*, int)
{
    if (result != CUDA_SUCCESS)
        not_here(function);
    return true;
}
bool check_cuda_result(cudaError_t result, const char* function, const char*, int)
{
    check(result, function);
    return true;
}

void* wp_cuda_context_get_current() { return nullptr; }
void* wp_cuda_stream_get_current() { return nullptr; }
int wp_cuda_stream_is_capturing(void*) { return 0; }

void* wp_alloc_device(void*, size_t bytes, const char*)
{
    void* made = nullptr;
    check(cudaMallocAsync(&made, bytes, nullptr), "allocation of Warp");
    return made;
}
void wp_free_device(void*, void* memory) { check(cudaFreeAsync(memory, nullptr), "free of Warp"); }
bool wp_memcpy_h2d(void*, void* to, void* from, size_t bytes, void*)
{
    check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice), "copy of Warp");
    return true;
}
bool wp_memcpy_d2h(void*, void* to, void* from, size_t bytes, void*)
{
    check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost), "copy of Warp");
    return true;
}
bool wp_memcpy_d2d(void*, void* to, void* from, size_t bytes, void*)
{
    check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToDevice), "copy of Warp");
    return true;
}
bool wp_memset_device(void*, void* to, int value, size_t bytes, void*)
{
    check(cudaMemsetAsync(to, value, bytes), "memset of Warp");
    return true;
}

// Both arrays have room for 2 * count; the sorted half is to be the first.
void radix_sort_pairs_device(void*, uint64_t* keys, int* values, int count, int begin_bit,
                             int end_bit)
{
    static void* room = nullptr;
    static size_t room_bytes = 0;
    cub::DoubleBuffer<uint64_t> both_keys(keys, keys + count);
    cub::DoubleBuffer<int> both_values(values, values + count);
    size_t bytes = 0;
    check(cub::DeviceRadixSort::SortPairs(nullptr, bytes, both_keys, both_values, count, begin_bit,
                                          end_bit),
          "sort");
    if (bytes > room_bytes) {
        check(cudaFree(room), "sort");
        check(cudaMalloc(&room, bytes), "sort");
        room_bytes = bytes;
    }
    check(cub::DeviceRadixSort::SortPairs(room, bytes, both_keys, both_values, count, begin_bit,
                                          end_bit),
          "sort");
    if (both_keys.Current() != keys)
        check(cudaMemcpyAsync(keys, both_keys.Current(), sizeof(uint64_t) * count,
                              cudaMemcpyDeviceToDevice),
              "sort");
    if (both_values.Current() != values)
        check(cudaMemcpyAsync(values, both_values.Current(), sizeof(int) * count,
                              cudaMemcpyDeviceToDevice),
              "sort");
}

namespace wp {

void set_error_string(const char* text, ...) { not_here(text); }
void bvh_create_host(vec3*, vec3*, int, int, int*, int, BVH&)
{
    not_here("a tree made on the host");
}
void bvh_destroy_host(BVH&) { not_here("a tree made on the host"); }
void reorder_top_down_bvh(BVH&) { not_here("a tree made on the host"); }
void bvh_add_descriptor(uint64_t, const BVH&) { not_here("a handle"); }
bool bvh_get_descriptor(uint64_t, BVH&) { not_here("a handle"); }
void bvh_rem_descriptor(uint64_t) { not_here("a handle"); }
void cubql_bvh_create_device(void*, vec3*, vec3*, int, int, BVH&) { not_here("cuBQL"); }
void cubql_bvh_rebuild_device(BVH&) { not_here("cuBQL"); }

}  // namespace wp
