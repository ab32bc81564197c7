// SPDX-License-Identifier: MIT
//
// The paper's table and figure, printed from a run of ours.
#pragma once

#include <optional>
#include <string>

#include "harness/record.h"

namespace bvhbench {

/// Nodes that a tree of 2t-1 nodes would not need, in percent, counted the way the paper's Table 1 does:
/// of 2t-1 for an Oi-BVH; for the perfect tree, what an Oi-BVH saves, of all its nodes.
double padding_percent(const Cell& cell);

/// Table 1, each of our numbers beside the paper's.
std::string table1_report(const Document& document);

/// Fig. 8 as a table: nodes built per second, by size and builder, and where the two algorithms cross.
std::string fig8_report(const Document& document);

/// The number of triangles from which on oibvh-multi is at least as fast as oibvh-single, at every size
/// measured; nothing if it never is, or always.
std::optional<std::int64_t> crossing_triangles(const Document& document);

}  // namespace bvhbench
