// SPDX-License-Identifier: MIT
//
// Bullet: its dynamic tree against itself, and its quantized tree for static meshes, asked with the box of every triangle.
#include "host_method.h"
#include "tree_writer.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <BulletCollision/BroadphaseCollision/btQuantizedBvh.h>

#include <limits>
#include <memory>

namespace {

btVector3 low_of(const adapter::Box& box) { return {box.low[0], box.low[1], box.low[2]}; }
btVector3 high_of(const adapter::Box& box) { return {box.high[0], box.high[1], box.high[2]}; }

/// btDbvt: leaves are inserted in a scattered order, which takes a fifth of the time that neighbours one after another take.
/// optimizeTopDown would cost more than it saves the one query.
class Dynamic : public adapter::HostMethod {
public:
    bvhbench_tree tree() override
    {
        return writer_.written(
            static_cast<const btDbvtNode*>(tree_.m_root), [](const btDbvtNode* node) {
                const btVector3 &low = node->volume.Mins(), &high = node->volume.Maxs();
                adapter::Spelled<const btDbvtNode*> spelled{
                    {low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}, {}, {}};
                if (node->isleaf())
                    spelled.triangles = {triangle_of(node)};
                else
                    spelled.children = {node->childs[0], node->childs[1]};
                return spelled;
            });
    }

protected:
    void make_tree() override
    {
        tree_.clear();
        constexpr uint64_t prime = 2654435761;  // above all counts, so that every triangle is met
        for (uint64_t k = 0; k < triangles(); ++k) {
            const uint64_t t = k * prime % triangles();
            tree_.insert(btDbvtVolume::FromMM(low_of(boxes()[t]), high_of(boxes()[t])),
                         reinterpret_cast<void*>(t));
        }
    }

    void find_pairs() override
    {
        struct Found : btDbvt::ICollide {
            Dynamic* to;
            void Process(const btDbvtNode* a, const btDbvtNode* b) override
            {
                to->add(0, triangle_of(a), triangle_of(b));
            }
        } found;
        found.to = this;
        tree_.collideTTpersistentStack(tree_.m_root, tree_.m_root, found);
    }

    uint64_t tree_bytes() const override
    {
        return (2 * uint64_t{triangles()} - 1) * sizeof(btDbvtNode);
    }

private:
    static uint32_t triangle_of(const btDbvtNode* leaf)
    {
        return static_cast<uint32_t>(reinterpret_cast<std::uintptr_t>(leaf->data));
    }

    btDbvt tree_;
    adapter::TreeWriter writer_;
};

/// btQuantizedBvh: its boxes are of 16 bits a side, so that each triangle that it reports is compared with exact boxes.
class Quantized : public adapter::HostMethod {
protected:
    // A node keeps the number of a triangle in 21 bits.
    uint64_t most_triangles() const override { return 1u << (31 - MAX_NUM_PARTS_IN_BITS); }

    void make_tree() override
    {
        constexpr float far = std::numeric_limits<float>::max();
        adapter::Box whole{{far, far, far}, {-far, -far, -far}};
        for (const adapter::Box& box : boxes())
            for (int axis = 0; axis < 3; ++axis) {
                whole.low[axis] = std::min(whole.low[axis], box.low[axis]);
                whole.high[axis] = std::max(whole.high[axis], box.high[axis]);
            }
        tree_ = std::make_unique<btQuantizedBvh>();
        tree_->setQuantizationValues(low_of(whole), high_of(whole));
        QuantizedNodeArray& leaves = tree_->getLeafNodeArray();
        leaves.resize(static_cast<int>(triangles()));
        for (uint32_t t = 0; t < triangles(); ++t) {
            btQuantizedBvhNode& leaf = leaves[static_cast<int>(t)];
            tree_->quantize(leaf.m_quantizedAabbMin, low_of(boxes()[t]), 0);
            tree_->quantize(leaf.m_quantizedAabbMax, high_of(boxes()[t]), 1);
            leaf.m_escapeIndexOrTriangleIndex = static_cast<int>(t);
        }
        tree_->buildInternal();
    }

    void find_pairs() override
    {
        struct Found : btNodeOverlapCallback {
            Quantized* to;
            unsigned thread;
            uint32_t own;
            void processNode(int, int triangle) override
            {
                const auto other = static_cast<uint32_t>(triangle);
                if (own < other && adapter::overlap(to->boxes()[own], to->boxes()[other]))
                    to->add(thread, own, other);
            }
        };
        adapter::in_parallel(triangles(), [this](unsigned thread, uint32_t own) {
            Found found;
            found.to = this;
            found.thread = thread;
            found.own = own;
            tree_->reportAabbOverlappingNodex(&found, low_of(boxes()[own]), high_of(boxes()[own]));
        });
    }

    uint64_t tree_bytes() const override
    {
        return 2 * uint64_t{triangles()} * sizeof(btQuantizedBvhNode);
    }

private:
    std::unique_ptr<btQuantizedBvh> tree_;
};

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {
        adapter::method<adapter::HostCollider<Dynamic>>(
            "bullet-dbvt",
            "btDbvt: insert in a scattered order; collideTTpersistentStack; one core"),
        adapter::method<adapter::HostCollider<Quantized>>(
            "bullet-quantized",
            "btQuantizedBvh: buildInternal on one core; reportAabbOverlappingNodex on all")};
    static const std::string version =
        std::to_string(btGetVersion() / 100) + "." + std::to_string(btGetVersion() % 100);
    return adapter::plugin(host_abi, "Bullet", version.c_str(), "Zlib", "host", methods);
}
