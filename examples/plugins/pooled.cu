// SPDX-License-Identifier: MIT
//
// Compiled beside an adapter and linked with --wrap=cudaMalloc --wrap=cudaFree, it lets the library allocate from the device's pool,
// whose memory is kept between calls (cuda_method.cuh). Some libraries allocate in each build, and the driver takes longer for that
// than a small build does.
#include <cuda_runtime.h>

extern "C" {

cudaError_t __wrap_cudaMalloc(void** memory, size_t bytes)
{
    return cudaMallocAsync(memory, bytes, nullptr);
}

cudaError_t __wrap_cudaFree(void* memory)
{
    return memory == nullptr ? cudaSuccess : cudaFreeAsync(memory, nullptr);
}

}  // extern "C"
