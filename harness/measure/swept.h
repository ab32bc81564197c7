// SPDX-License-Identifier: MIT
//
// Boxes swept between two frames, the broad phase of continuous collision detection: which vertices may meet which faces,
// and which edges which edges, on the way from a frame to the next.
#pragma once

#include "harness/measure/collide.h"

namespace bvhbench {

/// As collide_frames, a task whose `swept` is set, by steps from each frame to the next. A step is two queries, a cell a
/// pipeline each: vertices against faces, whose objects these are, and edges against each other, which are one object. A
/// pipeline has both unless its pairs are those between objects, or within. Pairs that share a vertex are left out.
///
/// A cell is held to the sweep, and where the scene's folder says more of a step (scenes/ground_truth.h) to that: counters
/// ground_truth_pairs and ground_truth_missed, and reference_pairs_count, how many pairs its meta.json counts. `add` gets
/// the cells of a query.
///
/// Throws BadUsage for what has no meaning with swept boxes, and Unavailable for a scene of one frame.
void collide_swept(Session& session, const CollideTask& task, int& order,
                   const std::function<void(std::vector<Cell>&&, const Found&)>& add,
                   const std::function<bool(std::size_t cells)>& passes);

}  // namespace bvhbench
