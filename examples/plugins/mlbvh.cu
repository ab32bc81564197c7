// SPDX-License-Identifier: MIT
//
// GPU_IPC: its LBVH of faces, whose boxes are of doubles. Its own query takes vertices and finds the faces near them; the walk over
// its nodes is ours.
#include "stack_walk.cuh"

#include <mlbvh.cuh>

#include <cmath>

namespace {

__global__ void as_doubles(const float* from, uint64_t count, double* to)
{
    const uint64_t k = uint64_t(blockIdx.x) * blockDim.x + threadIdx.x;
    if (k < count)
        to[k] = from[k];
}

// Node 0 is the root; leaves come last, in the order of their codes, so that neighbours walk alike. A box's doubles have the values
// of floats, so that it is exact.
struct Tree {
    const Node* nodes;
    const AABB* boxes;
    uint32_t first_leaf;
    static constexpr uint32_t root = 0;

    __device__ uint32_t leaf(uint32_t k) const { return first_leaf + k; }
    __device__ const AABB& box(uint32_t n) const { return boxes[n]; }
    __device__ bool is_leaf(uint32_t n) const { return n >= first_leaf; }
    __device__ uint32_t triangle(uint32_t n) const { return nodes[n].element_idx; }
    __device__ uint2 children(uint32_t n) const { return {nodes[n].left_idx, nodes[n].right_idx}; }
    static __device__ bool overlap(const AABB& a, const AABB& b)
    {
        return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
               b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
    }
};

class Mlbvh : public adapter::WalkedMethod {
public:
    ~Mlbvh() override
    {
        if (reserved_)
            bvh_.FREE_DEVICE_MEM();
    }

    // The library's boxes begin at 1e32 and grow.
    void load(const float* points) override
    {
        for (uint64_t k = 0; k < 3 * vertices(); ++k)
            if (!(std::abs(points[k]) < 1e32f))
                throw std::runtime_error("a coordinate is " + std::to_string(points[k]) +
                                         "; GPU_IPC takes magnitudes below 1e32");
        WalkedMethod::load(points);
    }

    bvhbench_tree tree() override
    {
        const auto nodes = adapter::downloaded(bvh_._nodes, 2ull * triangles() - 1);
        const auto boxes = adapter::downloaded(bvh_._bvs, 2ull * triangles() - 1);
        return writer_.written(0u, [&](uint32_t number) {
            const Node& node = nodes[number];
            const double3 &low = boxes[number].lower, &high = boxes[number].upper;
            adapter::Spelled<uint32_t> spelled{{float(low.x), float(low.y), float(low.z)},
                                               {float(high.x), float(high.y), float(high.z)},
                                               {},
                                               {}};
            if (number + 1 >= triangles())
                spelled.triangles = {node.element_idx};
            else
                spelled.children = {node.left_idx, node.right_idx};
            return spelled;
        });
    }

protected:
    void reserve() override
    {
        WalkedMethod::reserve();
        points_.allocate(vertices());
        static_assert(sizeof(uint3) == 3 * sizeof(uint32_t));
        auto* all = reinterpret_cast<uint3*>(const_cast<uint32_t*>(faces()));
        // What only its query reads is left out.
        bvh_.init(nullptr, points_.data(), all, nullptr, nullptr, nullptr, nullptr, nullptr,
                  static_cast<int>(triangles()), static_cast<int>(vertices()));
        reserved_ = true;
    }

    // The library makes the boxes itself, from points in double precision.
    void find_boxes() override
    {
        static_assert(sizeof(double3) == 3 * sizeof(double));
        const uint64_t count = 3 * vertices();
        as_doubles<<<static_cast<unsigned int>((count + 255) / 256), 256>>>(points(), count,
                                                                            &points_.data()->x);
        adapter::check(cudaGetLastError(), "points in double precision");
    }

    void make_tree() override
    {
        bvh_.Construct();
        adapter::check(cudaGetLastError(), "Construct");
    }

    void find_pairs() override { walk(Tree{bvh_._nodes, bvh_._bvs, triangles() - 1}); }

private:
    adapter::DeviceArray<double3> points_;
    lbvh_f bvh_;
    bool reserved_ = false;
    adapter::TreeWriter writer_;
};

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {adapter::method<adapter::CudaCollider<Mlbvh>>(
        "mlbvh", "lbvh_f, an LBVH with boxes of doubles; a walk of this adapter finds the pairs")};
    return adapter::plugin(host_abi, "GPU_IPC", LIBRARY_VERSION, "MPL-2.0", adapter::device_name(),
                           methods);
}
