// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "harness/base/interrupt.h"
#include "harness/base/json_keys.h"
#include "harness/record/output.h"
#include "harness/record/record.h"

namespace bvhbench {

/// Returns the rules for a result file. A file of the run `own_run` may be replaced without --force.
OutputRules result_rules(bool force, std::vector<std::string> inputs, std::string own_run = {});

/// What is known of a run only when it ends.
struct EndOfRun {
    std::int64_t compile_ns = 0;
    std::vector<std::string> turns_with = {};  ///< ids of the runs that this run took turns with
    std::optional<double> other_processes =
        {};  ///< mean number of them that wanted to run between samples
};

/// A result file that grows: it is rewritten atomically as cells finish.
///
/// Rewrites are at least half a second apart, so that a run of many short cells does not spend its time on the disk. A process
/// that is killed without warning loses at most the cells of that time. Devices and pipes are written once, by finish(). An
/// existing file stays until a cell has been measured.
class ResultFile {
public:
    /// If the existing file belongs to the run `goes_on`, continues that run and keeps its facts and cells.
    ResultFile(Output output, Json run, const std::string& goes_on = {});
    /// Writes unwritten cells and ignores errors. Call finish() to see them.
    ~ResultFile();

    void add(const Cell& cell);
    void add(const StressCell& cell);

    /// True if the next `count` cells exist already, in a run that is continued; they are then skipped. If any of them is
    /// missing, drops those that exist, because all of them will be measured again.
    bool pass(std::size_t count);

    /// Writes unwritten cells. Any thread may call it; the signal thread does.
    void keep();

    /// Returns the smallest sample order above those of all existing cells.
    int next_order() const { return next_order_; }

    /// Records the end of the run and writes the file if it has a cell worth keeping.
    void finish(const EndOfRun& end);

    /// Returns the number of cells.
    std::size_t size() const { return cells_.size() + stress_.size(); }

    std::string run_id() const { return run_.at("id"); }

    /// Returns the whole document, whether or not it is written to a file.
    std::string text() const;

    /// Returns the exit code of a command with these cells: 1 if one is wrong, else 0. Throws NothingMeasured with the first
    /// reason if there are cells and none was measured.
    int exit_code() const;

    /// Returns one line: "written: r.json", or that the file was left unchanged.
    std::string written() const;

private:
    /// A cell's JSON text, which is made only once, and its outcome.
    struct Kept {
        std::string text;
        bool is_measured, differs;
        std::string reason;
    };

    void take_over(const std::string& run_id);
    void write_if_due();
    bool is_worth_writing() const;
    void write();

    Output output_;
    Json run_;
    std::vector<Kept> cells_;
    std::vector<std::string> stress_;
    bool has_measured_ = false;  ///< whether there are cells that may replace an existing file
    std::size_t passed_ = 0;     ///< number of existing cells skipped by pass()
    bool goes_on_ = false;       ///< whether existing cells remain beyond passed_
    int next_order_ = 0;
    std::chrono::steady_clock::time_point written_at_;
    bool is_written_ = true;
    std::timed_mutex mutex_;  ///< guards cells_, stress_ and the writing
    std::optional<AtSignal> at_signal_;
};

}  // namespace bvhbench
