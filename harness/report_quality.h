// SPDX-License-Identifier: MIT
//
// Tree quality on the console: of any run, and the paper's table and figure about it from a run of ours.
#pragma once

#include <map>
#include <string>

#include "harness/record.h"

namespace bvhbench {

/// The surface area costs of the two kinds of tree that the paper compares, over the same leaves.
///
/// All radix trees of one order are the same tree, and so are all Oi-BVHs: whichever builder made it counts.
struct CostPair {
    const Cell* radix = nullptr;
    const Cell* oibvh = nullptr;

    /// Oi-BVH over radix tree; 0 if one of them has no cost.
    double ratio() const;
};

/// 0 if the cell was not measured or has none.
double sah_cost(const Cell* cell);

/// How good each tree is, a line each; empty unless end-point overlap was asked for.
std::string quality_report(const Document& document);

/// Table 4, each of our numbers beside the paper's.
std::string table4_report(const Document& document);

/// Fig. 13 as a table: by distance of the one triangle, both costs and how many times the one is the other.
std::string fig13_report(const Document& document);

}  // namespace bvhbench
