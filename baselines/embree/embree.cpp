// SPDX-License-Identifier: MIT
//
// Embree's builders, configured for binary nodes and one triangle per leaf. rtcBuildBVH calls back for every node and leaf, from
// all its threads, and the callbacks link them. Our colliders query the tree, so that trees are compared and not Embree's
// traversal of its wider trees.
#include <string>
#include <vector>

#include "baselines/baselines.h"
#include "baselines/embree/device.h"
#include "baselines/host/host_builder.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

/// Deeper than any tree built here. At the limit, by default 32, Embree splits sets in halves instead of by its own criterion.
constexpr unsigned max_depth = 1024;

// Nodes are created in Embree's memory by its threads.
//
//     Inner  boxes and addresses of both children        Leaf  its box and triangle
struct Node {
    bool is_leaf;
};

struct Leaf : Node {
    uint primitive;
    Aabb box;
};

struct Inner : Node {
    Aabb boxes[2];
    const Node* children[2];
};

Aabb box_of(const RTCBounds& bounds)
{
    return {bounds.lower_x, bounds.lower_y, bounds.lower_z,
            bounds.upper_x, bounds.upper_y, bounds.upper_z};
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned, void*)
{
    return new (rtcThreadLocalAlloc(allocator, sizeof(Inner), 16)) Inner{{false}, {}, {}};
}

void set_children(void* node, void** children, unsigned count, void*)
{
    for (unsigned i = 0; i < count; ++i)
        static_cast<Inner*>(node)->children[i] = static_cast<const Node*>(children[i]);
}

void set_boxes(void* node, const RTCBounds** bounds, unsigned count, void*)
{
    for (unsigned i = 0; i < count; ++i)
        static_cast<Inner*>(node)->boxes[i] = box_of(*bounds[i]);
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                  std::size_t, void*)
{
    const RTCBuildPrimitive& only = *primitives;
    const Aabb box = {only.lower_x, only.lower_y, only.lower_z,
                      only.upper_x, only.upper_y, only.upper_z};
    Node* leaf =
        new (rtcThreadLocalAlloc(allocator, sizeof(Leaf), 16)) Leaf{{true}, only.primID, box};
    return leaf;
}

/// The tree in Embree's memory. The boxes of inner nodes are those that Embree computed.
class EmbreeTree final : public Tree {
public:
    const Node* root = nullptr;
    std::size_t triangles = 0;

    std::size_t node_count() const override { return 2 * triangles - 1; }

    HostTree to_host_tree() const override
    {
        HostTree tree;
        std::vector<const Node*> found{root};
        tree.nodes.resize(1);
        std::size_t leaves = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (found[i]->is_leaf) {
                const auto& leaf = static_cast<const Leaf&>(*found[i]);
                tree.nodes[i].box = leaf.box;
                tree.nodes[i].primitive = static_cast<int>(leaf.primitive);
                ++leaves;
                continue;
            }
            const auto& inner = static_cast<const Inner&>(*found[i]);
            if (i == 0)
                tree.nodes[0].box = merged(inner.boxes[0], inner.boxes[1]);
            for (std::size_t side = 0; side < 2; ++side) {
                tree.nodes[i].child[side] = static_cast<int>(found.size());
                tree.nodes.emplace_back().box = inner.boxes[side];
                found.push_back(inner.children[side]);
            }
        }
        if (leaves != triangles)
            throw Unavailable("Embree built a tree of " + std::to_string(leaves) + " of " +
                              std::to_string(triangles) + " triangles");
        return tree;
    }
};

class Embree final : public HostBuilder {
public:
    Embree(std::string_view name, std::string_view method, RTCBuildQuality quality)
        : HostBuilder(name, method), device_(start_embree()), bvh_(rtcNewBVH(device_.get()))
    {
        arguments_ = rtcDefaultBuildArguments();
        arguments_.buildQuality = quality;
        arguments_.maxBranchingFactor = 2;
        arguments_.maxDepth = max_depth;
        arguments_.maxLeafSize = 1;
        arguments_.bvh = bvh_.get();
        arguments_.createNode = create_node;
        arguments_.setNodeChildren = set_children;
        arguments_.setNodeBounds = set_boxes;
        arguments_.createLeaf = create_leaf;
    }

private:
    /// Counts nodes, boxes and the primitives given to Embree. Embree does not report what else it allocates and keeps.
    Footprint footprint(std::size_t primitives) const override
    {
        return {(primitives - 1) * sizeof(Inner) + primitives * sizeof(Leaf),
                primitives * (sizeof(Aabb) + sizeof(RTCBuildPrimitive))};
    }

    void reserve_own(std::size_t primitives) override
    {
        boxes_.resize(primitives);
        tree_.root = nullptr;
        tree_.triangles = primitives;
        primitives_.resize(primitives);
    }

    /// Copies the boxes to `primitives_` before each build, since rtcBuildBVH rearranges its input. Untimed, since a program
    /// without other use for the boxes would write them there in the first place.
    void prepare(const Input& input, Queue& queue, Start start) override
    {
        HostBuilder::prepare(input, queue, start);
        for (std::size_t k = 0; k < boxes_.size(); ++k) {
            const Aabb& box = boxes_[k];
            require_in_range(box, k);
            primitives_[k] = {box.min_x, box.min_y, box.min_z, 0,
                              box.max_x, box.max_y, box.max_z, static_cast<uint>(k)};
        }
    }

    void build_tree() override
    {
        arguments_.primitives = primitives_.data();
        arguments_.primitiveCount = primitives_.size();
        arguments_.primitiveArrayCapacity = primitives_.size();
        tree_.root = static_cast<const Node*>(rtcBuildBVH(&arguments_));
        require_success(device_, "built no tree");
        if (tree_.root == nullptr)
            throw Unavailable("Embree built no tree");
    }

    const Tree& tree() const override { return tree_; }

    EmbreeHandle<RTCDevice> device_;
    EmbreeHandle<RTCBVH> bvh_;
    RTCBuildArguments arguments_{};
    std::vector<RTCBuildPrimitive> primitives_;
    EmbreeTree tree_;
};

}  // namespace

std::unique_ptr<Builder> make_embree_low(Programs&, const BuildOptions&)
{
    return std::make_unique<Embree>(
        "embree-low", "Embree, low quality: Morton codes, on all host threads [Wald2014]",
        RTC_BUILD_QUALITY_LOW);
}

std::unique_ptr<Builder> make_embree_medium(Programs&, const BuildOptions&)
{
    return std::make_unique<Embree>(
        "embree-medium", "Embree, medium quality: binned SAH, on all host threads [Wald2014]",
        RTC_BUILD_QUALITY_MEDIUM);
}

// No splitPrimitive callback is set, because spatial splits put a triangle in several leaves, and trees here have each triangle
// in exactly one. Without splits Embree builds as for medium quality.
std::unique_ptr<Builder> make_embree_high(Programs&, const BuildOptions&)
{
    return std::make_unique<Embree>(
        "embree-high",
        "Embree, high quality without splits: binned SAH, on all host threads [Wald2014]",
        RTC_BUILD_QUALITY_HIGH);
}

}  // namespace bvhbench
