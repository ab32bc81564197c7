// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "harness/choice/scene_choice.h"
#include "harness/session/session.h"

namespace bvhbench {

/// What is shown, of one frame of one scene.
struct ViewTask {
    std::string scene;
    std::size_t frame = 0;
    PipelineChoice pipeline;
};

/// A small scene as a report shows it in three dimensions: what is drawn is what a builder over the frame's triangles as one object
/// and a collider over that very tree left, held to the oracles. As JSON:
///
/// {"run": {...}, "cell": {...}, "points": [x,y,z,...], "faces": [a,b,c,...], "levels": [{"leaves": n, "boxes": [...]}],
/// "pairs": [a,b,...], "contacts": [a,b,...]}: run and cell as in a result file, without samples, all else flat lists. A level is
/// the nodes as far from the root as each other: six sides a box, min x, y, z, max x, y, z, of inner nodes, then of
/// leaves. There are none of a tree that breaks a promise.
///
/// Throws BadUsage for a scene that is too large and for a collider without a tree, Unavailable where the pipeline fails.
std::string view_text(Session& session, const ViewTask& task, std::vector<std::string> command);

}  // namespace bvhbench
