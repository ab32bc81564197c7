// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "harness/choice/scene_choice.h"
#include "harness/session/session.h"

namespace bvhbench {

/// The frame and pipeline that a view shows.
struct ViewTask {
    std::string scene;
    std::size_t frame = 0;
    PipelineChoice pipeline;
};

/// Returns a small scene as JSON, for a report that draws it in three dimensions. It has the tree that a builder left over the
/// frame's triangles as one object, and the pairs and contacts that a collider found in that tree, checked against the oracles:
///
/// {"run": {...}, "cell": {...}, "points": [x,y,z,...], "faces": [a,b,c,...], "levels": [{"leaves": n, "boxes": [...]}],
/// "pairs": [a,b,...], "contacts": [a,b,...]}
///
/// "run" and "cell" are as in a result file, without samples; the rest are flat lists. A level has the nodes of one depth: six
/// numbers a box (min x, y, z, max x, y, z), inner nodes first, then leaves. "levels" is empty if the tree is invalid.
///
/// Throws BadUsage for a scene that is too large and for a collider without a tree, Unavailable if the pipeline fails.
std::string view_text(Session& session, const ViewTask& task, std::vector<std::string> command);

}  // namespace bvhbench
