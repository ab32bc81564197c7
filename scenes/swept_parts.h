// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "scenes/scene.h"

namespace bvhbench {

/// Vertices, edges and faces of a scene as triangles, so that whatever takes triangles takes them: a vertex v is (v, v, v),
/// an edge from a to b is (a, b, b). Their boxes are right, and two that name a common vertex share an index.
struct SweptParts {
    std::vector<Face> faces;
    std::vector<FaceRange> objects;  ///< those of one are held against the other's, or their own
};

/// All vertices, used or not, and behind them all faces in the order of the file, an object each: vertex-face pairs are those between the two.
SweptParts vertices_and_faces(const Scene& scene);

/// Each edge of the faces once, by its larger vertex and then by its smaller one, the smaller one named first; of a face
/// that names a vertex twice not that side. They are one object: edge-edge pairs are those within.
SweptParts unique_edges(const Scene& scene);

/// Where the edge between two vertices is among them; nothing if there is none.
std::optional<uint> place_of_edge(const SweptParts& unique_edges, uint a, uint b);

}  // namespace bvhbench
