// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "scenes/scene.h"

namespace bvhbench {

/// What a folder of frames says about the step from one of its frames to the next. A subset of the pairs whose swept
/// boxes overlap: those that were found to collide on the way, and a few that nearly do.
///
///     gt_vf.csv   vertex,face,collides        a line a pair, no heading; `collides` is 0 or 1
///     gt_ee.csv   a0,a1,b0,b1,collides        two edges by their vertices
///     meta.json   ccd: from_frame, to_frame (labels), vf_listed, ee_listed, vf_true, ee_true, swept_vf, swept_ee
struct GroundTruth {
    struct VertexFace {
        uint vertex, face;
    };
    struct EdgeEdge {
        uint a[2], b[2];  ///< vertices; the smaller one first
    };
    std::size_t from_frame = 0;  ///< the step is from it to the next
    std::vector<VertexFace> vertex_face;
    std::vector<EdgeEdge> edge_edge;
    /// How many pairs of swept boxes overlap and share no vertex, as who made the data counted them.
    std::optional<std::uint64_t> swept_vertex_face, swept_edge_edge;
};

/// The ground truth of the folder that the scene's frames were read from; nothing where there is none. What meta.json
/// says of it is held to what is listed. Throws Unavailable, in one sentence, naming file and line, for what is not
/// understood or names what the scene does not have.
std::optional<GroundTruth> ground_truth_of(const Scene& scene);

}  // namespace bvhbench
