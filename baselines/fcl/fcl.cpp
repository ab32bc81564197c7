// SPDX-License-Identifier: MIT
//
// The trees of FCL, the collision library of many robot planners: split at the mean of the triangles' centroids,
// one triangle a leaf, on one core. In double: FCL in float misses pairs.
#include <type_traits>

#include "baselines/baselines.h"
#include "baselines/fcl/model.h"
#include "baselines/host/host_builder.h"

namespace bvhbench {
namespace {

Point point_of(const fcl::Vector3d& p)
{
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

/// The model where FCL left it. `Volume` is what FCL keeps a node.
template <class Volume>
class FclTree final : public Tree {
public:
    std::unique_ptr<fcl::BVHModel<Volume>> model;

    std::size_t node_count() const override { return static_cast<std::size_t>(model->getNumBVs()); }

    /// Axis-aligned boxes are FCL's own: doubles that are floats. Of other volumes the tree keeps its nodes
    /// and gets the boxes of its triangles, so that trees are compared and not shapes.
    HostTree spelled_out() const override
    {
        HostTree tree;
        tree.nodes.resize(node_count());
        for (std::size_t i = tree.nodes.size(); i-- > 0;) {  // children come after their parent
            const fcl::BVNode<Volume>& from = model->getBV(static_cast<int>(i));
            HostTree::Node& node = tree.nodes[i];
            if (from.isLeaf())
                node.primitive = from.primitiveId();
            else
                node.child = {from.leftChild(), from.rightChild()};
            if constexpr (std::is_same_v<Volume, fcl::AABBd>)
                node.box = box_between(from.bv.min_, from.bv.max_);
            else
                node.box = from.isLeaf()
                               ? triangle(node.primitive)
                               : merged(box_of(tree, node.child[0]), box_of(tree, node.child[1]));
        }
        return tree;
    }

private:
    static Aabb box_between(const fcl::Vector3d& low, const fcl::Vector3d& high)
    {
        // Through triangle_box, which leaves no negative zeros.
        return triangle_box(point_of(low), point_of(high), point_of(low));
    }

    static Aabb box_of(const HostTree& tree, int node)
    {
        return tree.nodes[static_cast<std::size_t>(node)].box;
    }

    Aabb triangle(int primitive) const
    {
        const fcl::Triangle& corners = model->tri_indices[primitive];
        return triangle_box(point_of(model->vertices[corners[0]]),
                            point_of(model->vertices[corners[1]]),
                            point_of(model->vertices[corners[2]]));
    }
};

/// FCL has no stage of its own for leaf boxes: it fits each node to all triangles under it.
template <class Volume>
class Fcl final : public HostBuilder {
public:
    using HostBuilder::HostBuilder;

private:
    /// The nodes and FCL's array of triangle numbers, which is as long. Its copy of the mesh is not counted.
    Footprint footprint(std::size_t primitives) const override
    {
        const std::size_t nodes = 2 * primitives - 1;
        return {nodes * sizeof(fcl::BVNode<Volume>), nodes * sizeof(unsigned)};
    }

    void reserve_own(std::size_t) override {}

    /// Each time a new model: FCL warns on the terminal when one is filled again. Copying is not timed, as for every builder.
    void prepare(const Input& input, Queue&, Start) override
    {
        if (input.is_swept())
            throw BadUsage(
                "FCL builds over triangles of one frame, not over boxes swept to the next");
        tree_.model = model_of<Volume>(input.points, input.faces);
    }

    void build_tree() override { require_tree(tree_.model->endModel()); }

    const Tree& tree() const override { return tree_; }

    FclTree<Volume> tree_;
};

}  // namespace

std::unique_ptr<Builder> make_fcl_aabb(Programs&, const BuildOptions&)
{
    return std::make_unique<Fcl<fcl::AABBd>>(
        "fcl-aabb", "FCL, axis-aligned boxes in double, on one core of the host [Pan2012]");
}

std::unique_ptr<Builder> make_fcl_obbrss(Programs&, const BuildOptions&)
{
    return std::make_unique<Fcl<fcl::OBBRSSd>>(
        "fcl-obbrss",
        "FCL, oriented boxes and swept spheres in double, on one core of the host [Pan2012]");
}

}  // namespace bvhbench
