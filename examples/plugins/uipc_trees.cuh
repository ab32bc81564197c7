// SPDX-License-Identifier: MIT
//
// What both adapters of libuipc share. Its two trees without a stack have helpers of the same names, so that each is compiled
// apart. Names that CUDA 13 took from under muda are given back to it first.
#pragma once

#include "cuda_method.cuh"

#include <cub/cub.cuh>
#include <cuda/std/functional>

namespace cub {
using Equality = ::cuda::std::equal_to<>;
}

// libuipc writes this before an operation that CUB calls on the device; in CUDA 13 it means the host alone.
#undef CUB_RUNTIME_FUNCTION
#define CUB_RUNTIME_FUNCTION __host__ __device__

inline cudaError_t cudaGraphAddDependencies(cudaGraph_t graph, const cudaGraphNode_t* from,
                                            const cudaGraphNode_t* to, size_t count)
{
    return cudaGraphAddDependencies(graph, from, to, nullptr, count);
}

#include <collision_detection/aabb.h>
#include <muda/buffer.h>

namespace adapter {

using Aabb = uipc::backend::cuda::AABB;

template <class T>
muda::CBufferView<T> view(const T* data, uint64_t count)
{
    return muda::CBufferView<T>(const_cast<T*>(data), count);
}

/// What both trees without a stack share: they write into a list of their own, which they make larger themselves.
template <class Bvh>
class SelfQuery : public CudaMethod {
protected:
    uint64_t found() override { return pairs_.size(); }
    uint64_t most_pairs() const override { return UINT64_MAX; }
    const uint2* pair_list() const override
    {
        static_assert(sizeof(*pairs_.view().data()) == sizeof(uint2));
        return reinterpret_cast<const uint2*>(pairs_.view().data());
    }

    Bvh bvh_;
    typename Bvh::QueryBuffer pairs_;
};

}  // namespace adapter
