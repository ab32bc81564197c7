// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geometry/error.h"
#include "geometry/mesh.h"

namespace bvhbench {

template <class Number>
fcl::Vector3<Number> fcl_point(const Point& p)
{
    return {static_cast<Number>(p.x), static_cast<Number>(p.y), static_cast<Number>(p.z)};
}

/// Throws Unavailable if `result`, returned by an FCL call that builds or refits a tree, is an error.
inline void require_tree(int result)
{
    if (result != fcl::BVH_OK)
        throw Unavailable("FCL built no tree: its error " + std::to_string(result));
}

/// Returns a model that contains the mesh and has no tree yet.
template <class Volume>
std::unique_ptr<fcl::BVHModel<Volume>> model_of(std::span<const Point> points,
                                                std::span<const Face> faces)
{
    using Number = typename Volume::S;
    std::vector<fcl::Vector3<Number>> vertices;
    for (const Point& p : points)
        vertices.push_back(fcl_point<Number>(p));
    std::vector<fcl::Triangle> triangles;
    for (const Face& face : faces)
        triangles.emplace_back(face.a, face.b, face.c);
    auto model = std::make_unique<fcl::BVHModel<Volume>>();
    model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
    model->addSubModel(vertices, triangles);
    return model;
}

}  // namespace bvhbench
