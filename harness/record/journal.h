// SPDX-License-Identifier: MIT
//
// The measured cells of a run that has not ended, beside its result file: JSON Lines, one for each cell, so that a process that is
// killed loses the cell it was measuring. The file is removed once the result file has its cells.
//
//     {"run": {...}}                    the facts of a process's run, whose cells follow
//     {"part": "3f..", "cell": {...}}   a cell of a part of the plan
//     {"part": "3f..", "keeps": 2}      the part is measured again from its third cell on
//     {"part": "3f..", "ended": 1.5}    the part is complete; it took this many seconds
#pragma once

#include <filesystem>
#include <map>
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

/// What earlier processes have measured.
struct Measured {
    std::vector<Json>
        runs;  ///< in the order of their beginning: facts, or what a merged file keeps of them
    std::map<std::string, MeasuredPart> parts;
    std::vector<std::string> order;  ///< keys of the parts, as they were begun
    Json last_run;                   ///< all facts of the last run; null: nothing was measured

    std::size_t cell_count() const;
};

/// Reads a result file whose cells name their parts. Throws BadUsage if it is none, or has a cell without a part.
Measured measured_in(const std::filesystem::path& path);

/// Adds what a journal has. A last line that was cut off is left out. Throws Unavailable for a file that is no journal.
void add_journal(const std::filesystem::path& path, Measured& measured);

/// Appends lines to a journal.
class Journal {
public:
    Journal() = default;
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Opens the file, and removes a last line that was cut off. Throws Unavailable with the system's reason, as append() does.
    void open(std::filesystem::path path);

    /// Appends a line of JSON at once. Does nothing before open().
    void append(const std::string& line);

private:
    std::filesystem::path path_;
    int file_ = -1;
};

}  // namespace bvhbench
