// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <mutex>
#include <optional>

#include "harness/interrupt.h"
#include "harness/record.h"

namespace bvhbench {

/// Replace `path` by `text` so that, whenever the program or the machine stops, one of the two is there whole:
/// a temporary file in the same folder, fsync, rename. Throws Unavailable with the system's reason.
void write_atomically(const std::filesystem::path& path, const std::string& text);

/// All of a file. Throws Unavailable, "WHAT 'path' cannot be read".
std::string file_text(const std::filesystem::path& path, const std::string& what);

/// Read a result file. Throws Unavailable if it is not there, cannot be read or is none.
Document read_result_file(const std::filesystem::path& path);

/// A result file that grows: rewritten whole and atomically as cells finish.
///
/// Rewrites are at least half a second apart, so that a thousand short cells do not spend their time on the
/// disk: what is killed without warning loses at most that. Without a path, nothing is written.
class ResultFile {
public:
    /// Throws Unavailable if `path` cannot be written. What is there is replaced by the first cell; but if it is what the
    /// run called `goes_on` has left there, that run goes on: its facts and cells stay.
    ResultFile(std::filesystem::path path, RunFacts run, const std::string& goes_on = {});
    /// Writes what is not written yet; a failure to do so stays silent here, so call finish().
    ~ResultFile();
    ResultFile(const ResultFile&) = delete;
    ResultFile& operator=(const ResultFile&) = delete;

    void add(Cell cell);
    void add(StressCell cell);

    /// Whether the next `count` cells are there from before, in a run that goes on. If some are missing the others go as
    /// well, to be made anew.
    bool pass(std::size_t count);

    /// Write what is not written yet. May be called by any thread; a signal does, too.
    void keep();

    /// The first place in the order of samples that none of its cells has.
    int next_order() const;

    /// The runs that took turns with this one.
    void took_turns(std::vector<std::string> others) { document_.run.turns_with = std::move(others); }

    /// Set the end of the run, and write.
    void finish(std::int64_t compile_ns);

    /// Not while another thread adds cells.
    const Document& document() const { return document_; }

private:
    void take_over(const std::string& run_id);
    void write_if_due();
    void write();

    std::filesystem::path path_;
    Document document_;
    std::vector<std::string> cell_texts_;  ///< each cell is turned into text once
    std::size_t passed_ = 0;               ///< cells that are done, of those from before
    bool goes_on_ = false;                 ///< whether cells behind them are from before too
    std::vector<std::string> stress_texts_;
    std::chrono::steady_clock::time_point written_at_;
    bool is_written_ = true;
    std::timed_mutex mutex_;  ///< of cells, their texts and what is written
    std::optional<AtSignal> at_signal_;
};

}  // namespace bvhbench
