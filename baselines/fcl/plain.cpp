// SPDX-License-Identifier: MIT
//
// fcl::collide of two models, asked for all contacts and nothing about them, in both of FCL's precisions and with its
// smallest and its usual volume.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>

#include <limits>
#include <memory>

#include "baselines/plain_libraries.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

template <class Volume>
std::shared_ptr<fcl::BVHModel<Volume>> model_of(std::span<const Point> points,
                                                std::span<const Face> faces)
{
    using Number = typename Volume::S;
    std::vector<fcl::Vector3<Number>> vertices;
    for (const Point& p : points)
        vertices.emplace_back(static_cast<Number>(p.x), static_cast<Number>(p.y),
                              static_cast<Number>(p.z));
    std::vector<fcl::Triangle> triangles;
    for (const Face& face : faces)
        triangles.emplace_back(face.a, face.b, face.c);
    auto model = std::make_shared<fcl::BVHModel<Volume>>();
    model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
    model->addSubModel(vertices, triangles);
    if (const int result = model->endModel(); result != fcl::BVH_OK)
        throw Unavailable("FCL built no tree: its error " + std::to_string(result));
    return model;
}

template <class Volume>
std::vector<Pair> find(std::span<const Point> points, std::span<const Face> faces,
                       std::span<const FaceRange> objects)
{
    using Number = typename Volume::S;
    const FaceRange first = objects.front(), second = objects.back();
    const auto a = model_of<Volume>(points, faces.subspan(first.first, first.count));
    const auto b = model_of<Volume>(points, faces.subspan(second.first, second.count));
    const fcl::Transform3<Number> in_place = fcl::Transform3<Number>::Identity();
    const fcl::CollisionRequest<Number> request(std::numeric_limits<std::size_t>::max(), false);
    fcl::CollisionResult<Number> result;
    fcl::collide(a.get(), in_place, b.get(), in_place, request, result);
    std::vector<Pair> found;
    for (std::size_t k = 0; k < result.numContacts(); ++k) {
        const auto& contact = result.getContact(k);
        const Pair pair = {first.first + static_cast<uint>(contact.b1),
                           second.first + static_cast<uint>(contact.b2)};
        const bool is_asked =
            objects.size() > 1 || pair.a < pair.b;  // of one object both ways are told
        if (is_asked && !share_a_vertex(faces[pair.a], faces[pair.b]))
            found.push_back(pair);
    }
    return found;
}

}  // namespace

std::vector<Pair> plain_fcl_aabb_double(std::span<const Point> points, std::span<const Face> faces,
                                        std::span<const FaceRange> objects)
{
    return find<fcl::AABB<double>>(points, faces, objects);
}

std::vector<Pair> plain_fcl_obbrss_double(std::span<const Point> points,
                                          std::span<const Face> faces,
                                          std::span<const FaceRange> objects)
{
    return find<fcl::OBBRSS<double>>(points, faces, objects);
}

std::vector<Pair> plain_fcl_aabb_float(std::span<const Point> points, std::span<const Face> faces,
                                       std::span<const FaceRange> objects)
{
    return find<fcl::AABB<float>>(points, faces, objects);
}

std::vector<Pair> plain_fcl_obbrss_float(std::span<const Point> points, std::span<const Face> faces,
                                         std::span<const FaceRange> objects)
{
    return find<fcl::OBBRSS<float>>(points, faces, objects);
}

}  // namespace bvhbench
