// SPDX-License-Identifier: MIT
//
// Box3D: its tree over the triangles of a mesh, split in two ways, and its dynamic tree, which is inserted into and rebuilt.
#include "host_method.h"
#include "tree_writer.h"

#include <box3d/collision.h>
#include <box3d/constants.h>
#include <box3d/math_functions.h>

#include <cmath>
#include <memory>

namespace {

b3AABB of_library(const adapter::Box& box)
{
    return {{box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.high[2]}};
}

template <class Ref>
adapter::Spelled<Ref> spelled(const b3Vec3& low, const b3Vec3& high)
{
    return {{low.x, low.y, low.z}, {high.x, high.y, high.z}, {}, {}};
}

enum class Split { BinnedSah, Median };

/// b3CreateMesh. Its query asks which triangles touch a box, and not which boxes overlap it: the walk is ours.
template <Split split>
class Mesh : public adapter::HostMethod {
public:
    void prepare(const bvhbench_mesh& mesh) override
    {
        HostMethod::prepare(mesh);
        corners_.resize(3 * mesh.triangles);
        numbers_.resize(3 * mesh.triangles);
        for (std::size_t k = 0; k < numbers_.size(); ++k)
            numbers_[k] = static_cast<int32_t>(k);
        stacks_.resize(adapter::thread_count());
    }

    bvhbench_tree tree() override
    {
        return writer_.written(b3GetMeshNodes(mesh_.get()), [this](const b3MeshNode* node) {
            auto here = spelled<const b3MeshNode*>(node->lowerBound, node->upperBound);
            if (is_leaf(*node))
                for (uint32_t k = 0; k < node->data.asLeaf.triangleCount; ++k)
                    here.triangles.push_back(triangle_at(node->triangleOffset + k));
            else
                here.children = {node + 1, node + node->data.asNode.childOffset};
            return here;
        });
    }

protected:
    // Offsets in the mesh are of 31 bits, and a triangle takes 114 bytes at most.
    uint64_t most_triangles() const override { return 1u << 24; }

    // The library keeps a triangle's vertices, but not its number: no two triangles share a vertex here, and vertices tell it.
    void make_tree() override
    {
        set_unit();
        adapter::in_parallel(triangles(), [this](unsigned, uint32_t t) { set_corners(t); });
        b3MeshDef def{};
        def.vertices = corners_.data();
        def.indices = numbers_.data();
        def.vertexCount = static_cast<int>(corners_.size());
        def.triangleCount = static_cast<int>(triangles());
        def.useMedianSplit = split == Split::Median;
        mesh_.reset();
        mesh_.reset(b3CreateMesh(&def, nullptr, 0));
        if (!mesh_ || mesh_->triangleCount != def.triangleCount)
            throw std::runtime_error(mesh_ ? "Box3D left triangles out" : "Box3D made no mesh");
    }

    // Triangles are taken in the order of the leaves, so that neighbours walk alike.
    void find_pairs() override
    {
        adapter::in_parallel(triangles(), [this](unsigned thread, uint32_t k) {
            const uint32_t own = triangle_at(k);
            const adapter::Box box = boxes()[own];
            const b3AABB asked = of_library(box);
            std::vector<const b3MeshNode*>& waiting = stacks_[thread];
            waiting.assign(1, b3GetMeshNodes(mesh_.get()));
            while (!waiting.empty()) {
                const b3MeshNode& node = *waiting.back();
                waiting.pop_back();
                if (!b3AABB_Overlaps({node.lowerBound, node.upperBound}, asked))
                    continue;
                if (!is_leaf(node)) {
                    waiting.push_back(&node + node.data.asNode.childOffset);
                    waiting.push_back(&node + 1);
                    continue;
                }
                for (uint32_t at = 0; at < node.data.asLeaf.triangleCount; ++at) {
                    const uint32_t other = triangle_at(node.triangleOffset + at);
                    if (own < other && adapter::overlap(box, boxes()[other]))
                        add(thread, own, other);
                }
            }
        });
    }

    uint64_t tree_bytes() const override
    {
        return corners_.size() * sizeof(b3Vec3) + numbers_.size() * sizeof(int32_t) +
               (mesh_ ? static_cast<uint64_t>(mesh_->byteCount) : 0);
    }

private:
    static bool is_leaf(const b3MeshNode& node) { return node.data.asLeaf.type == 3; }

    uint32_t triangle_at(uint32_t place) const
    {
        return static_cast<uint32_t>(b3GetMeshTriangles(mesh_.get())[place].index1) / 3;
    }

    /// The library measures by its unit what is too far out, and what is too small to be a triangle: it is the least that can be.
    void set_unit()
    {
        float farthest = 1;
        for (const float side : points())
            farthest = std::max(farthest, std::abs(side));
        if (!(farthest < 1e18f))
            throw std::runtime_error("a coordinate is " + std::to_string(farthest) +
                                     "; this adapter takes magnitudes below 1e18");
        b3SetLengthUnitsPerMeter(farthest / 5e4f);
    }

    /// A triangle that is still too small, which the library would leave out, becomes one with a larger box.
    void set_corners(uint32_t t)
    {
        b3Vec3* corner = &corners_[3 * std::size_t{t}];
        for (int k = 0; k < 3; ++k) {
            const float* point = &points()[3 * std::size_t{faces()[3 * std::size_t{t} + k]}];
            corner[k] = {point[0], point[1], point[2]};
        }
        const b3Vec3 across = b3Cross(b3Sub(corner[1], corner[0]), b3Sub(corner[2], corner[0]));
        const float slop = B3_LINEAR_SLOP;
        if (b3Length(across) < 0.1f * slop * slop) {  // the library: half of that below 0.01
            const b3AABB box = of_library(boxes()[t]);
            const b3Vec3 far{2 * slop, 2 * slop, 2 * slop};
            corner[0] = b3Sub(box.lowerBound, far);
            corner[1] = b3Add(box.upperBound, far);
            corner[2] = {corner[0].x, corner[1].y, corner[0].z};
        }
    }

    struct Destroy {
        void operator()(b3MeshData* mesh) const { b3DestroyMesh(mesh); }
    };

    std::vector<b3Vec3> corners_;
    std::vector<int32_t> numbers_;
    std::unique_ptr<b3MeshData, Destroy> mesh_;
    std::vector<std::vector<const b3MeshNode*>> stacks_;
    adapter::TreeWriter writer_;
};

/// b3DynamicTree: leaves are inserted, and what is above them is made anew, as the library does for its compounds.
class Dynamic : public adapter::HostMethod {
public:
    Dynamic() = default;
    Dynamic(const Dynamic&) = delete;
    Dynamic& operator=(const Dynamic&) = delete;
    ~Dynamic() override { b3DynamicTree_Destroy(&tree_); }

    bvhbench_tree tree() override
    {
        return writer_.written(tree_.root, [this](int number) {
            const b3TreeNode& node = tree_.nodes[number];
            auto here = spelled<int>(node.aabb.lowerBound, node.aabb.upperBound);
            if (node.flags & b3_leafNode)
                here.triangles = {static_cast<uint32_t>(node.userData)};
            else
                here.children = {node.children.child1, node.children.child2};
            return here;
        });
    }

protected:
    uint64_t most_triangles() const override { return INT32_MAX / 2; }

    void make_tree() override
    {
        b3DynamicTree_Destroy(&tree_);
        tree_ = b3DynamicTree_Create(static_cast<int>(triangles()));
        for (uint32_t t = 0; t < triangles(); ++t) {
            b3DynamicTree_CreateProxy(&tree_, of_library(boxes()[t]), 1, t);
            // Many equal boxes make a chain. The library's walks have room for 1024 nodes and leave out what has none.
            if (b3DynamicTree_GetHeight(&tree_) > 1000)
                b3DynamicTree_Rebuild(&tree_, true);
        }
        b3DynamicTree_Rebuild(&tree_, true);
    }

    void find_pairs() override
    {
        struct Asked {
            Dynamic* to;
            unsigned thread;
            uint32_t own;
        };
        adapter::in_parallel(triangles(), [this](unsigned thread, uint32_t own) {
            Asked asked{this, thread, own};
            b3DynamicTree_Query(
                &tree_, of_library(boxes()[own]), 1, false,
                [](int, uint64_t other, void* context) {
                    const Asked& by = *static_cast<Asked*>(context);
                    if (by.own < other)
                        by.to->add(by.thread, by.own, static_cast<uint32_t>(other));
                    return true;
                },
                &asked);
        });
    }

    uint64_t tree_bytes() const override
    {
        return sizeof(tree_) + uint64_t(tree_.nodeCapacity) * sizeof(b3TreeNode) +
               uint64_t(tree_.rebuildCapacity) * (sizeof(int) + sizeof(b3Vec3));
    }

private:
    b3DynamicTree tree_{};
    adapter::TreeWriter writer_;
};

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {
        adapter::method<adapter::HostCollider<Mesh<Split::BinnedSah>>>(
            "box3d-mesh",
            "b3CreateMesh, binned SAH, one core; a walk of this adapter on all finds the pairs"),
        adapter::method<adapter::HostCollider<Mesh<Split::Median>>>(
            "box3d-mesh-median",
            "b3CreateMesh, median split, one core; a walk of this adapter on all finds the pairs"),
        adapter::method<adapter::HostCollider<Dynamic>>(
            "box3d-tree",
            "b3DynamicTree: insert and rebuild on one core, b3DynamicTree_Query on all")};
    return adapter::plugin(host_abi, "Box3D", LIBRARY_VERSION, "MIT", "host", methods);
}
