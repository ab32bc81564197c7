// SPDX-License-Identifier: MIT
//
// Files of queries of continuous collision detection, as Wang et al. (2021) publish them: 8 lines a query, the four points at time 0 and
// then at time 1, each x, y and z as numerator and denominator, separated by commas; a seventh number is 1 if the query touches and 0 if not.
// A query is `v f0 f1 f2` in files of a folder vertex-face or named *vf.csv, and `a0 a1 b0 b1` in those of edge-edge or *ee.csv.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/aabb.h"
#include "geometry/moving_query.h"

namespace bvhbench {

/// Queries of one kind, of one file or of several.
struct QuerySet {
    std::string name;  ///< such as "erleben-wedges/edge-edge"
    std::vector<MovingQuery> queries;
    /// Whether each touches, as its source says: by a seventh number, or by a list of true and false in a file of the same name, less
    /// `_queries`, in the folder `truth` beside it. Empty if the source says nothing of a file.
    std::vector<char> published;

    /// Returns the box around all points at the start, as they are rounded to floats.
    Aabb box() const;
};

/// Returns the sets of a file, or of all .csv files under a folder, by name: those of one folder and kind are one set, and queries whose
/// coordinates are all floats are apart, in a set whose name ends in " floats". Coordinates must be doubles exactly. Throws Unavailable, in
/// one sentence that names file and line, for anything else, for a file whose name says no kind, and if there are no queries.
std::vector<QuerySet> read_queries(const std::filesystem::path& path);

}  // namespace bvhbench
