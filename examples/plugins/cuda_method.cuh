// SPDX-License-Identifier: MIT
//
// What adapters of CUDA libraries share: the mesh on the device, boxes of triangles, stages by events, a list of pairs that grows.
#pragma once

#include "cuda_pairs.cuh"
#include "method.h"

#include <cuda_runtime.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace adapter {

inline void check(cudaError_t result, const char* what)
{
    if (result != cudaSuccess)
        throw std::runtime_error(std::string(what) + ": " + cudaGetErrorString(result));
}

/// Returns the name of device 0, or why there is none.
inline std::string device_name()
{
    cudaDeviceProp properties;
    const cudaError_t result = cudaGetDeviceProperties(&properties, 0);
    return result == cudaSuccess ? properties.name
                                 : std::string("no CUDA device: ") + cudaGetErrorString(result);
}

/// An array on the device.
template <class T>
class DeviceArray {
public:
    DeviceArray() = default;
    DeviceArray(const DeviceArray&) = delete;
    DeviceArray& operator=(const DeviceArray&) = delete;
    ~DeviceArray() { cudaFree(data_); }

    /// Makes room for `count` elements; what it held is lost.
    void allocate(uint64_t count)
    {
        cudaFree(data_);
        data_ = nullptr;
        size_ = 0;
        const uint64_t bytes = count * sizeof(T);
        check(cudaMalloc(&data_, bytes),
              ("allocating " + std::to_string(bytes) + " bytes").c_str());
        size_ = count;
    }

    void upload(const void* from)
    {
        check(cudaMemcpy(data_, from, size_ * sizeof(T), cudaMemcpyHostToDevice), "upload");
    }

    T* data() const { return data_; }
    uint64_t size() const { return size_; }

private:
    T* data_ = nullptr;
    uint64_t size_ = 0;
};

template <class T>
std::vector<T> downloaded(const T* from, uint64_t count)
{
    std::vector<T> to(count);
    check(cudaMemcpy(to.data(), from, count * sizeof(T), cudaMemcpyDeviceToHost), "download");
    return to;
}

/// A closed box, as the libraries' own: each adapter asserts that theirs has this layout.
struct Box {
    float low[3], high[3];
};
static_assert(sizeof(Box) == 24);

/// Writes the boxes as pairs of corners, as most libraries take them.
struct WriteBox {
    Box* boxes;

    __device__ void operator()(uint32_t t, const Box& box) const { boxes[t] = box; }
};

/// Calls write(t, box) with the box of each triangle t.
template <class Write>
__global__ void triangle_boxes(const float* points, const uint32_t* faces, uint32_t triangles,
                               Write write)
{
    const uint32_t t = blockIdx.x * blockDim.x + threadIdx.x;
    if (t >= triangles)
        return;
    const uint32_t* face = faces + 3ull * t;
    const float *a = points + 3ull * face[0], *b = points + 3ull * face[1],
                *c = points + 3ull * face[2];
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = fminf(fminf(a[axis], b[axis]), c[axis]);
        box.high[axis] = fmaxf(fmaxf(a[axis], b[axis]), c[axis]);
    }
    write(t, box);
}

/// Keeps the device busy for some 200 µs.
static __global__ void keep_busy()
{
    const auto now = [] {
        unsigned long long ns;
        asm volatile("mov.u64 %0, %globaltimer;" : "=l"(ns));
        return ns;
    };
    for (const unsigned long long begin = now(); now() - begin < 200'000;)
        ;
}

/// A method on device 0 and its default stream. An adapter says how to make, refit and query the tree.
class CudaMethod : public Method {
public:
    CudaMethod()
    {
        check(cudaSetDevice(0), "device 0");
        check(cudaFree(nullptr), "starting CUDA");
        // Libraries that allocate from the device's pool in every build get its memory back without a call to the driver.
        cudaMemPool_t pool;
        check(cudaDeviceGetDefaultMemPool(&pool, 0), "pool of device 0");
        uint64_t keep = UINT64_MAX;
        check(cudaMemPoolSetAttribute(pool, cudaMemPoolAttrReleaseThreshold, &keep), "pool");
        for (cudaEvent_t& event : events_)
            check(cudaEventCreate(&event), "event");
        size_t free = 0, total = 0;
        check(cudaMemGetInfo(&free, &total), "memory");
        free_before_ = free;
    }
    ~CudaMethod() override
    {
        for (const cudaEvent_t event : events_)
            cudaEventDestroy(event);
    }

    void prepare(const bvhbench_mesh& mesh) override
    {
        if (mesh.triangles < 2 || mesh.triangles > INT32_MAX / 2)
            throw std::runtime_error(std::to_string(mesh.triangles) +
                                     " triangles; this adapter takes 2 to " +
                                     std::to_string(INT32_MAX / 2));
        triangles_ = static_cast<uint32_t>(mesh.triangles);
        faces_.allocate(3 * mesh.triangles);
        faces_.upload(mesh.faces);
        points_.allocate(3 * mesh.vertices);
        boxes_.allocate(mesh.triangles);
        pairs_.allocate(16 * mesh.triangles);
        count_.allocate(1);
        reserve();
    }

    void load(const float* points) override { points_.upload(points); }

    void build(bvhbench_stages& stages) override
    {
        forget_tree();
        begin();
        find_boxes();
        mark(1);
        make_tree();
        mark(2);
        read(stages, {"bounds", "build"});
    }

    // Device memory that this process has taken since the method was made, the libraries' pools included.
    uint64_t bytes() override
    {
        size_t free = 0, total = 0;
        return cudaMemGetInfo(&free, &total) == cudaSuccess && free < free_before_
                   ? free_before_ - free
                   : 0;
    }

protected:
    virtual void reserve() {}      // memory of the library's own, before the first build
    virtual void forget_tree() {}  // the tree of the last build
    virtual void make_tree() = 0;  // from boxes()
    virtual void refit_tree() {}
    virtual void find_pairs() {}
    /// Returns how many pairs the last find_pairs() has found; more than room().room if they did not fit.
    virtual uint64_t found() { return downloaded(count_.data(), 1)[0]; }

    // Where the pairs are: a library that writes into a list of its own overrides both.
    virtual uint64_t most_pairs() const { return pairs_.size(); }
    virtual const uint2* pair_list() const { return pairs_.data(); }

    // What build, refit and query of plugin.h are for a class that overrides the functions above.
    void timed_refit(bvhbench_stages& stages)
    {
        begin();
        find_boxes();
        mark(1);
        refit_tree();
        mark(2);
        read(stages, {"bounds", "refit"});
    }

    // A list that was too small is made larger, and the query is made again: its stage is that of the last.
    void timed_query(bvhbench_stages& stages)
    {
        for (bool fits = false; !fits;) {
            begin();
            check(cudaMemsetAsync(count_.data(), 0, sizeof(unsigned long long)), "count of pairs");
            find_pairs();
            mark(1);
            pair_count_ = found();
            fits = pair_count_ <= most_pairs();
            if (!fits)
                pairs_.allocate(pair_count_ + pair_count_ / 4);
        }
        read(stages, {"broad"});
    }

    PairList read_pairs()
    {
        host_pairs_ = downloaded(pair_list(), pair_count_);
        return {pair_count_, &host_pairs_.data()->x};
    }

    template <class Walk>
    void find_pairs_by(const Walk& walk, uint32_t queries)
    {
        walk_all<<<(queries + query_threads - 1) / query_threads, query_threads>>>(walk, queries,
                                                                                   room());
        check(cudaGetLastError(), "query");
    }

    uint32_t triangles() const { return triangles_; }
    uint64_t vertices() const { return points_.size() / 3; }
    const uint32_t* faces() const { return faces_.data(); }  // on the device, as the next
    const float* points() const { return points_.data(); }
    PairRoom room() const { return {pairs_.data(), count_.data(), pairs_.size()}; }

    template <class LibraryBox>
    LibraryBox* boxes() const
    {
        static_assert(sizeof(LibraryBox) == sizeof(Box),
                      "six floats: the least x, y, z, then the greatest");
        return reinterpret_cast<LibraryBox*>(boxes_.data());
    }

    /// Makes boxes(), or the library's own arrays of boxes, from the points.
    virtual void find_boxes() { find_boxes_by(WriteBox{boxes_.data()}); }

    template <class Write>
    void find_boxes_by(const Write& write)
    {
        triangle_boxes<<<(triangles_ + 255) / 256, 256>>>(points_.data(), faces_.data(), triangles_,
                                                          write);
        check(cudaGetLastError(), "boxes of triangles");
    }

    /// Starts the first stage. Between two calls the GPU has served bvhbench's own process, and to change over takes it more than
    /// 100 µs; this and the launches of what follows pass while it is kept busy. bvhbench gives its own commands a head start too.
    void begin()
    {
        keep_busy<<<1, 1>>>();
        mark(0);
    }

    void mark(int event) { check(cudaEventRecord(events_[event]), "event"); }

    /// Waits for the device. The stages are the spans between the events, in their order.
    void read(bvhbench_stages& stages, std::vector<const char*> names)
    {
        check(cudaDeviceSynchronize(), names.back());
        const auto since_first = [this](std::size_t event) {
            float ms = 0;
            check(cudaEventElapsedTime(&ms, events_[0], events_[event]), "event");
            return static_cast<uint64_t>(double(ms) * 1e6);
        };
        for (std::size_t k = 0; k < names.size(); ++k)
            add_stage(stages, names[k], since_first(k), since_first(k + 1), true);
    }

private:
    uint32_t triangles_ = 0;
    DeviceArray<uint32_t> faces_;
    DeviceArray<float> points_;
    DeviceArray<Box> boxes_;
    DeviceArray<uint2> pairs_;
    DeviceArray<unsigned long long> count_;
    uint64_t pair_count_ = 0;
    std::vector<uint2> host_pairs_;
    cudaEvent_t events_[3] = {};
    size_t free_before_ = 0;
};

/// Gives a CudaMethod the query of plugin.h.
template <class Tree>
class CudaCollider : public Tree {
public:
    void query(bvhbench_stages& stages) override { this->timed_query(stages); }
    PairList pairs() override { return this->read_pairs(); }
};

/// The same with a refit.
template <class Tree>
class RefittedCudaCollider : public CudaCollider<Tree> {
public:
    void refit(bvhbench_stages& stages) override { this->timed_refit(stages); }
};

}  // namespace adapter
