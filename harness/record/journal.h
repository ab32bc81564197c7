// SPDX-License-Identifier: MIT
//
// The measured cells of a run that has not ended, beside its result file: JSON Lines, one for each cell, so that a process that is
// killed loses the cell it was measuring. The file is removed once the result file has its cells. earlier_runs.h reads it.
//
//     {"run": {...}}                    the facts of a process's run, whose cells follow
//     {"part": "3f..", "cell": {...}}   a cell of a part of the plan; `stress` in place of `cell`: what stress found
//     {"part": "3f..", "keeps": 2}      the part is measured again from its third cell on
//     {"part": "3f..", "ended": 1.5}    the part is complete; it took this many seconds
#pragma once

#include <filesystem>
#include <string>

namespace bvhbench {

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

    /// Appends a line of a part, with `value`, which is JSON, as its `kind`.
    void append(const std::string& part, const char* kind, const std::string& value);

private:
    std::filesystem::path path_;
    int file_ = -1;
};

}  // namespace bvhbench
