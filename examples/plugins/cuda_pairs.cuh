// SPDX-License-Identifier: MIT
//
// Pairs that threads find, in a list on the device.
#pragma once

#include <cuda_runtime.h>

#include <cstdint>

namespace adapter {

/// Where pairs are written. `count` goes on when `room` is used up: it is the number of pairs that there are.
struct PairRoom {
    uint2* pairs;
    unsigned long long* count;
    unsigned long long room;
};

constexpr uint32_t query_threads = 128;

/// The pairs that a block finds: kept in shared memory and written together at the end, what does not fit at once.
struct BlockPairs {
    static constexpr uint32_t most = 2048;
    uint2 pair[most];
    uint32_t count;
    unsigned long long place;

    __device__ void add(uint32_t a, uint32_t b, const PairRoom& out)
    {
        const uint32_t at = atomicAdd(&count, 1);
        if (at < most) {
            pair[at] = make_uint2(a, b);
        } else {
            const unsigned long long far = atomicAdd(out.count, 1ull);
            if (far < out.room)
                out.pairs[far] = make_uint2(a, b);
        }
    }

    __device__ void write(const PairRoom& out)
    {
        const uint32_t kept = min(count, most);
        if (threadIdx.x == 0)
            place = atomicAdd(out.count, static_cast<unsigned long long>(kept));
        __syncthreads();
        for (uint32_t k = threadIdx.x; k < kept; k += blockDim.x)
            if (place + k < out.room)
                out.pairs[place + k] = pair[k];
    }
};

/// Calls `walk(k, add)` for k < queries, a thread each; the walk calls `add(a, b)` for every pair that it finds.
template <class Walk>
__global__ void __launch_bounds__(query_threads) walk_all(Walk walk, uint32_t queries, PairRoom out)
{
    __shared__ BlockPairs block;
    if (threadIdx.x == 0)
        block.count = 0;
    __syncthreads();
    const uint32_t k = blockIdx.x * blockDim.x + threadIdx.x;
    if (k < queries)
        walk(k, [&](uint32_t a, uint32_t b) { block.add(a, b, out); });
    __syncthreads();
    block.write(out);
}

}  // namespace adapter
