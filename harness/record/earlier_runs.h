// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "harness/base/json_keys.h"

namespace bvhbench {

/// What has been measured of a part of a plan: a scene with its builders or pipelines.
struct MeasuredPart {
    std::vector<Json> cells;  ///< each with the id of its `run`
    bool has_ended = false;
    double seconds = 0;  ///< that it took; 0: unknown
};

/// What earlier processes have measured, of the same run or of earlier runs.
struct EarlierRuns {
    std::vector<Json> runs;  ///< as they began: facts, or what a file of several runs keeps of each
    std::map<std::string, MeasuredPart> parts;
    std::vector<std::string> order;  ///< keys of the parts, as they began
    Json last_run;                   ///< all facts of the last run; null: there was none

    /// Returns the id of the last run; empty if there was none.
    std::string last_id() const;

    /// Throws BadUsage, naming `path`, if a part is none of `keys`, or if a run was made on another device than `run` or, unless
    /// `other_commits`, by another program.
    void check(const std::filesystem::path& path, const std::set<std::string>& keys,
               const Json& run, bool other_commits) const;
};

/// Reads a result file whose cells name their parts. Throws BadUsage if it is none, or has a cell without a part.
EarlierRuns runs_in_result(const std::filesystem::path& path);

/// Adds what a journal has (journal.h) and returns true, or returns false if the result file already has it: a process that is killed
/// just after it wrote that file leaves both. A last line that was cut off is left out. Throws Unavailable for a file that is no journal.
bool add_journal(const std::filesystem::path& path, EarlierRuns& earlier);

/// Returns what a file of several runs keeps of each (results/schema, `source`). `run` may be that already.
Json source_of(const Json& run);

}  // namespace bvhbench
