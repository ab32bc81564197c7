// SPDX-License-Identifier: MIT
//
// Included before everything of Kokkos 4.6.99 and of ArborX's adapter, with CUDA 13.
#pragma once

// Two calls, as Kokkos writes them and as they were before CUDA 13.
#ifdef __CUDACC__
#include <cuda_runtime.h>
inline cudaError_t cudaGraphAddDependencies(cudaGraph_t graph, const cudaGraphNode_t* from,
                                            const cudaGraphNode_t* to, size_t count)
{
    return cudaGraphAddDependencies(graph, from, to, nullptr, count);
}

inline cudaError_t cudaMemPrefetchAsync(const void* memory, size_t bytes, int device,
                                        cudaStream_t stream)
{
    cudaMemLocation location{};
    location.type = device == cudaCpuDeviceId ? cudaMemLocationTypeHost : cudaMemLocationTypeDevice;
    location.id = device == cudaCpuDeviceId ? 0 : device;
    return cudaMemPrefetchAsync(memory, bytes, location, 0, stream);
}
#endif

// Kokkos' mdspan marks empty members [[no_unique_address]], with which g++ and nvcc lay a View out differently: 40 and 32 bytes. So
// kernels read other members than the host wrote. Kokkos 4.7.02 leaves the attribute out for nvcc, and so do these.
#ifdef __NVCC__
#define MDSPAN_IMPL_USE_ATTRIBUTE_NO_UNIQUE_ADDRESS 1
#define MDSPAN_IMPL_USE_FAKE_ATTRIBUTE_NO_UNIQUE_ADDRESS
#define MDSPAN_IMPL_NO_UNIQUE_ADDRESS
#endif
