// SPDX-License-Identifier: MIT
//
// A small scene as a report shows it in three dimensions: what is drawn is what a builder and a collider left, checked.
#pragma once

#include <string>
#include <vector>

#include "collide/pairs.h"
#include "harness/measure/collide.h"
#include "harness/record/record.h"
#include "harness/session/session.h"

namespace bvhbench {

/// With more triangles a page takes long to open, and boxes hide each other.
constexpr std::size_t most_view_triangles = 100'000;

/// What is shown, of one frame of one scene.
struct ViewTask {
    std::string scene;
    std::size_t frame = 0;
    PipelineChoice pipeline;
};

/// Nodes of a tree as far from its root as each other: boxes of inner nodes, then of leaves.
struct ViewLevel {
    std::vector<float> sides;  ///< six a box: min x, y, z, max x, y, z
    std::size_t boxes = 0;
    std::size_t leaves = 0;  ///< the last so many of them
};

struct View {
    RunFacts run;
    Cell cell;  ///< who found it, and the verdict; no samples, since nothing was timed
    std::vector<Point> points;
    std::vector<Face> faces;
    std::vector<ViewLevel> levels;  ///< from the root's on; none of a tree that breaks a promise
    PairList pairs, contacts;       ///< of boxes that overlap, of triangles that intersect
};

/// Boxes of a tree that keeps its promises, by their distance from the root. Padding, which no child leads to, is on no level.
std::vector<ViewLevel> levels_of(const HostTree& tree);

/// Build over the frame's triangles as one object, query that very tree, and hold both to the oracles. Throws BadUsage for
/// more than `most_view_triangles` and for a collider without a tree, Unavailable where the pipeline fails.
View view_of(Session& session, const ViewTask& task, std::vector<std::string> command);

/// {"run": {...}, "cell": {...}, "points": [x,y,z,...], "faces": [a,b,c,...], "levels": [{"leaves": n, "boxes": [...]}],
/// "pairs": [a,b,...], "contacts": [a,b,...]}: run and cell as in a result file, all else flat lists.
std::string view_text(const View& view);

}  // namespace bvhbench
