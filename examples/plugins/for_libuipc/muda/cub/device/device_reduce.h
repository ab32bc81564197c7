// SPDX-License-Identifier: MIT
//
// Stands before muda's header of this name, which calls CUB with a parameter that CUDA 13 no longer has: the one reduction that
// libuipc's linear BVH needs.
#pragma once

#include <muda/cub/device/cub_wrapper.h>

#include <cub/device/device_reduce.cuh>

namespace muda {

class DeviceReduce : public CubWrapper<DeviceReduce> {
public:
    using CubWrapper<DeviceReduce>::CubWrapper;

    template <class In, class Out, class Operation, class Value>
    DeviceReduce& Reduce(In from, Out to, int count, Operation operation, Value start)
    {
        std::size_t bytes = 0;
        const auto reduce = [&](void* room) {
            checkCudaErrors(cub::DeviceReduce::Reduce(room, bytes, from, to, count, operation,
                                                      start, this->stream()));
        };
        reduce(nullptr);
        reduce(prepare_buffer(bytes));
        return *this;
    }
};

}  // namespace muda
