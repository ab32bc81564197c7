// SPDX-License-Identifier: MIT
//
// culbvh: Karras' LBVH with 64-byte nodes, its refit and its own query of a tree against itself.
#include "cuda_method.cuh"
#include "tree_writer.h"

#include <culbvh.cuh>

#include <array>
#include <cstring>
#include <map>

namespace {

using adapter::Box;
using Bound = culbvh::LBVH::aabb;

class Culbvh : public adapter::CudaMethod {
public:
    bvhbench_tree tree() override
    {
        const auto& on_device = bvh_.internal_nodes();
        const auto nodes =
            adapter::downloaded(thrust::raw_pointer_cast(on_device.data()), on_device.size());
        // The library does not show which triangle a leaf holds, but its box is that of the triangle, bit for bit.
        auto waiting = triangles_by_box();
        // A leaf is named by its parent and its side, which hold its box.
        struct Ref {
            uint32_t node;
            int side;  // -1: the node itself
        };
        using Spelled = adapter::Spelled<Ref>;
        const auto spelled = [](const Bound& box) {
            return Spelled{
                {box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}, {}, {}};
        };
        return writer_.written(Ref{0, -1}, [&](const Ref& ref) {
            const auto& node = nodes[ref.node];
            if (ref.side >= 0) {
                Spelled leaf = spelled(node.bounds[ref.side]);
                std::vector<uint32_t>& same = waiting.at(bits(&node.bounds[ref.side]));
                leaf.triangles = {same.back()};
                same.pop_back();
                return leaf;
            }
            Bound whole = node.bounds[0];
            whole.absorb(node.bounds[1]);
            Spelled inner = spelled(whole);
            for (const uint32_t child : {node.leftIdx, node.rightIdx})
                inner.children.push_back(child >> 31 ? Ref{ref.node, int(inner.children.size())}
                                                     : Ref{child, -1});
            return inner;
        });
    }

protected:
    void make_tree() override { bvh_.compute(boxes<Bound>(), triangles()); }
    void refit_tree() override { bvh_.refit(); }

    void find_pairs() override
    {
        static_assert(sizeof(int2) == sizeof(uint2));
        written_ = bvh_.query(reinterpret_cast<int2*>(room().pairs), room().room);
    }

    // The query stops counting when its list is full.
    uint64_t found() override { return written_ < room().room ? written_ : 2 * room().room; }

private:
    using Bits = std::array<uint32_t, 6>;

    static Bits bits(const void* box)
    {
        Bits copy;
        std::memcpy(copy.data(), box, sizeof copy);
        return copy;
    }

    std::map<Bits, std::vector<uint32_t>> triangles_by_box() const
    {
        std::map<Bits, std::vector<uint32_t>> found;
        const auto all = adapter::downloaded(boxes<Box>(), triangles());
        for (uint32_t t = 0; t < triangles(); ++t)
            found[bits(&all[t])].push_back(t);
        return found;
    }

    culbvh::LBVH bvh_;
    adapter::TreeWriter writer_;
    uint64_t written_ = 0;
};

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {
        adapter::method<adapter::RefittedCudaCollider<Culbvh>>(
            "culbvh",
            "LBVH of 64-byte nodes, refit, and the library's query of a tree against itself")};
    return adapter::plugin(host_abi, "culbvh", LIBRARY_VERSION, "MIT", adapter::device_name(),
                           methods);
}
