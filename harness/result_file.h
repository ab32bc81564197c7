// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>

#include "harness/record.h"

namespace bvhbench {

/// Replace `path` by `text` so that, whenever the program or the machine stops, one of the two is there whole:
/// a temporary file in the same folder, fsync, rename. Throws Unavailable with the system's reason.
void write_atomically(const std::filesystem::path& path, const std::string& text);

/// A result file that grows: rewritten whole and atomically as cells finish.
///
/// Rewrites are at least half a second apart, so that a thousand short cells do not spend their time on the
/// disk: what is killed without warning loses at most that. Without a path, nothing is written.
class ResultFile {
public:
    /// Throws Unavailable if `path` cannot be written. What is there is replaced by the first cell.
    ResultFile(std::filesystem::path path, RunFacts run);
    /// Writes what is not written yet; a failure to do so stays silent here, so call finish().
    ~ResultFile();
    ResultFile(const ResultFile&) = delete;
    ResultFile& operator=(const ResultFile&) = delete;

    void add(Cell cell);
    void add(StressCell cell);

    /// Set the end of the run, and write.
    void finish(std::int64_t compile_ns);

    const Document& document() const { return document_; }

private:
    void write_if_due();
    void write();

    std::filesystem::path path_;
    Document document_;
    std::vector<std::string> cell_texts_;  ///< each cell is turned into text once
    std::vector<std::string> stress_texts_;
    std::chrono::steady_clock::time_point written_at_;
    bool is_written_ = true;
};

}  // namespace bvhbench
