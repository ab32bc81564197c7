// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "harness/record.h"

namespace bvhbench {

/// What a cell is, whatever was found: experiment, scene with what was asked of it, frame, builder and collider with all their options, operation,
/// swept pairs and axis of accuracy. Cells of one text are measurements of one thing.
std::string identity_text(const Cell& cell);

/// Whether its samples begin with leaves that are lined up already.
bool starts_from_leaves(const Cell& cell);

/// Cells of two files that are of one thing, in the order of the first file, and those that only one of them has. Where a
/// file measured one thing several times, the first is paired with the first.
struct MatchedCells {
    std::vector<std::pair<const Cell*, const Cell*>> both;
    std::vector<const Cell*> only_first, only_second;
};
MatchedCells matched_cells(const std::vector<Cell>& first, const std::vector<Cell>& second);

/// A scene's name, with what was asked of it that is not usual: "bunny.ply, objects: mesh, 3 between".
std::string scene_label(const SceneFacts& scene);

/// What tables call it: scene, frame if there are several, pipeline.
std::string cell_label(const Cell& cell);

}  // namespace bvhbench
