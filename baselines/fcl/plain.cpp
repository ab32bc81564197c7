// SPDX-License-Identifier: MIT
//
// fcl::collide of two models, for all contacts without contact data, in both precisions, with FCL's smallest and its usual
// bounding volume.
#include <fcl/narrowphase/collision.h>

#include <limits>

#include "baselines/fcl/model.h"
#include "baselines/plain_libraries.h"

namespace bvhbench {
namespace {

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
    const fcl::Transform3<Number> in_place = fcl::Transform3<Number>::Identity();
    const fcl::CollisionRequest<Number> request(std::numeric_limits<std::size_t>::max(), false);
    fcl::CollisionResult<Number> result;
    fcl::collide(a.get(), in_place, b.get(), in_place, request, result);
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
