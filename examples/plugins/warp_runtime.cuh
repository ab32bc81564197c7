// SPDX-License-Identifier: MIT
//
// The functions of Warp's runtime that building and refitting an LBVH calls, on the default stream and with memory of the
// device's pool, as Warp has it. What other ways to build a tree would call fails. For warp.cu alone.
#pragma once

#include "cuda_method.cuh"

#include <bvh.h>
#include <cuda_util.h>
#include <cub/cub.cuh>

using adapter::check;

[[noreturn]] inline void not_here(const char* what)
{
    throw std::runtime_error(std::string("Warp asked for ") + what +
                             ", which this adapter does not have");
}

bool ContextGuard::always_restore = false;
static CudaTimingState no_timing(0, nullptr);  // every launch reads its flags
CudaTimingState* g_cuda_timing_state = &no_timing;

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
