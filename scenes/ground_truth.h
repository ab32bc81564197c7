// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "scenes/scene.h"

namespace bvhbench {

/// Vertices, edges and faces of a scene as triangles, for algorithms that take triangles: a vertex v is (v, v, v), an edge from
/// a to b is (a, b, b). Their boxes are exact, and two elements with a common vertex share an index.
struct SweptParts {
    std::vector<Face> faces;
    std::vector<FaceRange> objects;  ///< two: pairs between them; one: pairs within it
};

/// Returns all vertices, used or not, followed by all faces in the order of the file. Vertices and faces are one object each,
/// so vertex-face pairs are the pairs between the two objects.
SweptParts vertices_and_faces(const Scene& scene);

/// Returns each edge of the faces once, sorted by its larger and then by its smaller vertex, the smaller vertex named first.
/// Sides whose ends are the same vertex are left out. All edges are one object; edge-edge pairs are within it.
SweptParts unique_edges(const Scene& scene);

/// Returns the index of the edge between two vertices in `unique_edges`; nothing if there is no such edge.
std::optional<uint> place_of_edge(const SweptParts& unique_edges, uint a, uint b);

/// Ground truth for the step from one frame of a folder to the next: a subset of the pairs whose swept boxes overlap, with
/// those that were found to collide during the step and a few near misses.
///
///     gt_vf.csv   vertex,face,collides        one pair per line, no heading; `collides` is 0 or 1
///     gt_ee.csv   a0,a1,b0,b1,collides        two edges by their vertices
///     meta.json   ccd: from_frame, to_frame (labels), vf_listed, ee_listed, vf_true, ee_true, swept_vf, swept_ee
struct GroundTruth {
    using Pairs = std::vector<std::array<uint, 2>>;

    std::size_t from_frame = 0;  ///< the step leads from this frame to the next
    Pairs vertex_face;           ///< by indices into vertices_and_faces, in the order of the file
    Pairs edge_edge;             ///< by indices into unique_edges
    Pairs touching_vertex_face, touching_edge_edge;  ///< those of them that collide
    /// Numbers of pairs whose swept boxes overlap and that share no vertex, as counted by the authors of the data.
    std::optional<std::uint64_t> swept_vertex_face, swept_edge_edge;
};

/// Returns the ground truth in the folder that the scene's frames were read from, with triangles numbered as in the file;
/// nothing if there is none. `edges` is unique_edges of the scene. Counts in meta.json are checked against the lists. Throws
/// Unavailable, in one sentence that names file and line, for malformed lines and for elements that the scene does not have.
std::optional<GroundTruth> ground_truth_of(const Scene& scene, const SweptParts& edges);

}  // namespace bvhbench
