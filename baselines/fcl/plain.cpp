// SPDX-License-Identifier: MIT
//
// FCL's collision of two models, for all contacts without contact data, in both precisions, with FCL's smallest and its usual
// bounding volume. The functions inside fcl::collide are called, because fcl::collide in floats takes 40 s to compile: it contains
// the collisions of all other shapes.
#include <fcl/math/bv/utility.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include <limits>

#include "baselines/fcl/model.h"
#include "baselines/plain_libraries.h"

namespace bvhbench {
namespace {

/// FCL's traversal of two models, which depends on the volume.
template <class Volume>
struct Traversal {
    using Node = fcl::detail::MeshCollisionTraversalNode<Volume>;
    using Model = fcl::BVHModel<Volume>;
};
template <class Number>
struct Traversal<fcl::OBBRSS<Number>> {
    using Node = fcl::detail::MeshCollisionTraversalNodeOBBRSS<Number>;
    using Model = const fcl::BVHModel<fcl::OBBRSS<Number>>;
};

template <class Volume>
std::vector<Pair> find(std::span<const Point> points, std::span<const Face> faces,
                       std::span<const FaceRange> objects)
{
    using Number = typename Volume::S;
    const FaceRange first = objects.front(), second = objects.back();
    const auto a = model_of<Volume>(points, faces.subspan(first.first, first.count));
    const auto b = model_of<Volume>(points, faces.subspan(second.first, second.count));
    require_tree(a->endModel());
    require_tree(b->endModel());
    fcl::Transform3<Number> a_place = fcl::Transform3<Number>::Identity(), b_place = a_place;
    const fcl::CollisionRequest<Number> request(std::numeric_limits<std::size_t>::max(), false);
    fcl::CollisionResult<Number> result;
    typename Traversal<Volume>::Node node;
    typename Traversal<Volume>::Model &model_a = *a, &model_b = *b;
    fcl::detail::initialize(node, model_a, a_place, model_b, b_place, request, result);
    fcl::detail::collide(&node);
    std::vector<Pair> found;
    for (std::size_t k = 0; k < result.numContacts(); ++k) {
        const auto& contact = result.getContact(k);
        const Pair pair = {first.first + static_cast<uint>(contact.b1),
                           second.first + static_cast<uint>(contact.b2)};
        // For one object, FCL reports each pair in both orders.
        const bool is_asked = objects.size() > 1 || pair.a < pair.b;
        if (is_asked && !share_a_vertex(faces[pair.a], faces[pair.b]))
            found.push_back(pair);
    }
    return found;
}

}  // namespace

std::vector<PlainLibrary> plain_fcl()
{
    return {{"FCL AABB double", "FCL", true, find<fcl::AABB<double>>},
            {"FCL OBBRSS double", "FCL", true, find<fcl::OBBRSS<double>>},
            {"FCL AABB float", "FCL", true, find<fcl::AABB<float>>},
            {"FCL OBBRSS float", "FCL", true, find<fcl::OBBRSS<float>>}};
}

}  // namespace bvhbench
