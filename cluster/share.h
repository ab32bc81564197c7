// SPDX-License-Identifier: MIT
//
// The triangles of one rank, and how they move between ranks.
#pragma once

#include <span>
#include <vector>

#include "cluster/ranks.h"
#include "geometry/mesh.h"

namespace bvhbench {

/// A triangle as it is sent: 52 bytes.
struct CarriedTriangle {
    uint id;        ///< in the scene
    Face vertices;  ///< in the scene
    Point corners[3];
};
static_assert(sizeof(CarriedTriangle) == 52);

/// A mesh of some of a scene's triangles, ascending by id, and of the vertices that they use. No triangle is required.
struct Share {
    std::vector<uint> ids;    ///< of each triangle, in the scene
    std::vector<Face> faces;  ///< indices into `points`
    std::vector<Point> points;
    std::vector<uint> vertices;  ///< of each point, in the scene; ascending

    uint triangle_count() const { return static_cast<uint>(ids.size()); }

    /// Returns triangle k with vertices as numbered in the scene.
    Face scene_face(std::size_t k) const
    {
        const Face face = faces[k];
        return {vertices[face.a], vertices[face.b], vertices[face.c]};
    }
};

/// Returns triangle k of a share as it is sent.
CarriedTriangle carried_triangle(const Share& share, std::size_t k);

/// Returns the share of the triangles of several lists, in any order, each once. Ascending ones take less time and memory.
Share share_of(std::vector<std::vector<CarriedTriangle>> carried);

/// Returns the share of a run of triangles, which are numbered from `first_id` on.
Share share_of(MeshRun run, uint first_id);

/// Returns the first `count` triangles of a share, as a share.
Share first_of(const Share& share, std::size_t count);

/// Distributes a mesh that rank `holder` has and no other needs, in runs of consecutive triangles of about equal sizes.
Share dealt(std::span<const Point> points, std::span<const Face> faces, uint holder, Ranks& ranks);

/// Moves each triangle k of this rank to rank to[k]. Returns the triangles that the rank has then.
Share moved(Share share, std::span<const uint> to, Ranks& ranks);

/// Returns the centres of the triangles' boxes.
std::vector<Point> box_centres(const Share& share);

}  // namespace bvhbench
