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

/// Through triangle_box, which leaves no negative zeros.
Aabb box_around(const fcl::Vector3d& a, const fcl::Vector3d& b, const fcl::Vector3d& c)
{
    const auto point = [](const fcl::Vector3d& p) {
        return Point{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
    };
    return triangle_box(point(a), point(b), point(c));
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
        constexpr bool has_boxes = std::is_same_v<Volume, fcl::AABBd>;
        PlainTree tree;
        for (int i = 0; i < model->getNumBVs(); ++i) {
            const fcl::BVNode<Volume>& from = model->getBV(i);
            HostTree::Node& node = tree.plain.nodes.emplace_back();
            if constexpr (has_boxes)
                node.box = box_around(from.bv.min_, from.bv.max_, from.bv.min_);
            if (!from.isLeaf()) {
                node.child = {from.leftChild(), from.rightChild()};
                continue;
            }
            node.primitive = from.primitiveId();
            if constexpr (!has_boxes) {
                const fcl::Triangle& at = model->tri_indices[node.primitive];
                node.box = box_around(model->vertices[at[0]], model->vertices[at[1]],
                                      model->vertices[at[2]]);
            }
        }
        if constexpr (!has_boxes)
            tree.merge_boxes();
        return std::move(tree.plain);
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
