// SPDX-License-Identifier: MIT
//
// The trees of FCL, the collision library of many robot planners: split at the mean of the triangles' centroids, one triangle
// per leaf, built on one core. In double precision, because FCL in float misses pairs.
#include <type_traits>

#include "baselines/baselines.h"
#include "baselines/fcl/model.h"
#include "baselines/host/host_builder.h"

namespace bvhbench {
namespace {

/// Returns the box of three points, without negative zeros, as triangle_box computes it.
Aabb box_around(const fcl::Vector3d& a, const fcl::Vector3d& b, const fcl::Vector3d& c)
{
    const auto point = [](const fcl::Vector3d& p) {
        return Point{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
    };
    return triangle_box(point(a), point(b), point(c));
}

/// An FCL model as a tree. `Volume` is FCL's bounding volume of a node.
template <class Volume>
class FclTree final : public Tree {
public:
    std::unique_ptr<fcl::BVHModel<Volume>> model;

    std::size_t node_count() const override { return static_cast<std::size_t>(model->getNumBVs()); }

    /// If volumes are axis-aligned boxes, uses them; they are doubles with float values. Otherwise keeps the nodes and computes
    /// boxes from the triangles, so that topologies are compared and not volumes.
    HostTree to_host_tree() const override
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

/// There is no stage `bounds`, because FCL fits each node to all triangles under it.
template <class Volume>
class Fcl final : public HostBuilder {
public:
    using HostBuilder::HostBuilder;

private:
    /// Counts the nodes and FCL's equally long array of triangle indices. FCL's copy of the mesh is not counted.
    Footprint footprint(std::size_t primitives) const override
    {
        const std::size_t nodes = 2 * primitives - 1;
        return {nodes * sizeof(fcl::BVNode<Volume>), nodes * sizeof(unsigned)};
    }

    void reserve_own(std::size_t) override {}

    /// Creates a new model for each build, since FCL prints a warning if a model is filled again. Untimed, as in all builders.
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
