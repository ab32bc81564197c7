// SPDX-License-Identifier: MIT
//
// tinybvh: its builder with AVX and its refit. It has no overlap query: the walk over its binary tree is ours.
#define TINYBVH_IMPLEMENTATION
#include <tiny_bvh.h>

#include "host_method.h"
#include "tree_writer.h"

#include <memory>

namespace {

using Node = tinybvh::BVH::BVHNode;

class TinyBvh : public adapter::HostMethod {
public:
    void prepare(const bvhbench_mesh& mesh) override
    {
        HostMethod::prepare(mesh);
        vertices_.resize(std::max<uint64_t>(mesh.vertices, 1));
        bvh_ = std::make_unique<tinybvh::BVH>();
        stacks_.resize(adapter::thread_count());
    }

    void load(const float* points) override
    {
        HostMethod::load(points);
        for (std::size_t v = 0; v < this->points().size() / 3; ++v)
            vertices_[v] = {points[3 * v], points[3 * v + 1], points[3 * v + 2], 0};
    }

    bvhbench_tree tree() override
    {
        return writer_.written(0u, [this](uint32_t number) {
            const Node& node = bvh_->bvhNode[number];
            adapter::Spelled<uint32_t> spelled{{node.aabbMin.x, node.aabbMin.y, node.aabbMin.z},
                                               {node.aabbMax.x, node.aabbMax.y, node.aabbMax.z},
                                               {},
                                               {}};
            const uint32_t* ids = bvh_->primIdx + node.leftFirst;
            if (node.isLeaf())
                spelled.triangles.assign(ids, ids + node.triCount);
            else
                spelled.children = {node.leftFirst, node.leftFirst + 1};
            return spelled;
        });
    }

protected:
    uint64_t most_triangles() const override { return INT32_MAX / 2; }

    void make_tree() override { bvh_->BuildAVX(vertices_.data(), faces().data(), triangles()); }
    void refit_tree() override { bvh_->Refit(); }

    // Triangles are taken in the order of the leaves, so that neighbours walk alike.
    void find_pairs() override
    {
        adapter::in_parallel(triangles(), [this](unsigned thread, uint32_t k) {
            const uint32_t own = bvh_->primIdx[k];
            const adapter::Box box = boxes()[own];
            const auto meets = [&box](const Node& node) {
                return node.aabbMin.x <= box.high[0] && box.low[0] <= node.aabbMax.x &&
                       node.aabbMin.y <= box.high[1] && box.low[1] <= node.aabbMax.y &&
                       node.aabbMin.z <= box.high[2] && box.low[2] <= node.aabbMax.z;
            };
            std::vector<uint32_t>& waiting = stacks_[thread];
            waiting.assign(1, 0);
            while (!waiting.empty()) {
                const Node& node = bvh_->bvhNode[waiting.back()];
                waiting.pop_back();
                for (uint32_t at = node.leftFirst; at < node.leftFirst + node.triCount; ++at) {
                    const uint32_t other = bvh_->primIdx[at];
                    if (own < other && adapter::overlap(box, boxes()[other]))
                        add(thread, own, other);
                }
                if (!node.isLeaf())
                    for (const uint32_t child : {node.leftFirst + 1, node.leftFirst})
                        if (meets(bvh_->bvhNode[child]))
                            waiting.push_back(child);
            }
        });
    }

    uint64_t tree_bytes() const override
    {
        return vertices_.size() * sizeof(tinybvh::bvhvec4) +
               uint64_t{bvh_->allocatedNodes} * sizeof(Node) +
               triangles() * (sizeof(uint32_t) + sizeof(tinybvh::BVH::Fragment));
    }

private:
    std::vector<tinybvh::bvhvec4> vertices_;
    std::unique_ptr<tinybvh::BVH> bvh_;
    std::vector<std::vector<uint32_t>> stacks_;
    adapter::TreeWriter writer_;
};

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {adapter::method<
        adapter::RefittedHostCollider<TinyBvh>>(
        "tinybvh",
        "BuildAVX from triangles, all cores, and Refit; a walk of this adapter finds the pairs")};
    return adapter::plugin(host_abi, "tinybvh", LIBRARY_VERSION, "MIT", "host", methods);
}
