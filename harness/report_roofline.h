// SPDX-License-Identifier: MIT
//
// Stages beside what they would take at best: docs/measuring.md, Floors.
#pragma once

#include <string>
#include <vector>

#include "harness/record.h"

namespace bvhbench {

/// One stage of one cell beside its floor.
struct Floor {
    std::string scene;
    std::int64_t triangles = 0;
    std::string of;  ///< the builder, or the collider over its trees
    std::string stage;
    int launches = 0;
    double bytes = 0;       ///< that it must move, as declared
    double floor_ns = 0;    ///< of copying them, and of as many launches
    double reached_ns = 0;  ///< the median
};

/// Of every right cell: the stages of a build, and of a frame those that are the query's own. A stage whose launches
/// declared no bytes, or that ran on the host, has no floor; nor has any where the run measured no copy rate.
std::vector<Floor> floors_of(const Document& document);

/// They as a table, if the document is one of the experiment `roofline`.
std::string roofline_report(const Document& document);

}  // namespace bvhbench
