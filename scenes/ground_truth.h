// SPDX-License-Identifier: MIT
#pragma once

#include <array>
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

/// What a folder of frames says about the step from one of its frames to the next. A subset of the pairs whose swept
/// boxes overlap: those that were found to collide on the way, and a few that nearly do.
///
///     gt_vf.csv   vertex,face,collides        a line a pair, no heading; `collides` is 0 or 1
///     gt_ee.csv   a0,a1,b0,b1,collides        two edges by their vertices
///     meta.json   ccd: from_frame, to_frame (labels), vf_listed, ee_listed, vf_true, ee_true, swept_vf, swept_ee
struct GroundTruth {
    using Pairs = std::vector<std::array<uint, 2>>;

    std::size_t from_frame = 0;  ///< the step is from it to the next
    Pairs vertex_face;           ///< by places in vertices_and_faces, in the order of the file
    Pairs edge_edge;             ///< by places in unique_edges
    /// How many pairs of swept boxes overlap and share no vertex, as who made the data counted them.
    std::optional<std::uint64_t> swept_vertex_face, swept_edge_edge;
};

/// The ground truth of the folder that the scene's frames were read from, with the numbers that triangles have in it;
/// nothing where there is none. `edges` are its unique_edges. What meta.json says is held to what is listed. Throws
/// Unavailable, in one sentence, naming file and line, for what is not understood or names what the scene does not have.
std::optional<GroundTruth> ground_truth_of(const Scene& scene, const SweptParts& edges);

}  // namespace bvhbench
