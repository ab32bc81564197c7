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

/// The rules for a file of results: an earlier one that the run called `own_run` has left may be replaced.
OutputRules result_rules(bool force, std::vector<std::string> inputs, std::string own_run = {});

/// A result file that grows: rewritten whole and atomically as cells finish.
///
/// Rewrites are at least half a second apart, so that a thousand short cells do not spend their time on the
/// disk: what is killed without warning loses at most that. A device or pipe is written to once, by finish(). An earlier file
/// stays until a cell has been measured.
class ResultFile {
public:
    /// If the run called `goes_on` has left the file, that run goes on: its facts and cells stay.
    ResultFile(Output output, const RunFacts& run, const std::string& goes_on = {});
    /// Writes what is not written yet; a failure to do so stays silent here, so call finish().
    ~ResultFile();
    ResultFile(const ResultFile&) = delete;
    ResultFile& operator=(const ResultFile&) = delete;

    void add(const Cell& cell);
    void add(const StressCell& cell);

    /// Whether the next `count` cells are there from before, in a run that goes on. If some are missing the others go as
    /// well, to be made anew.
    bool pass(std::size_t count);

    /// Write what is not written yet. May be called by any thread; a signal does, too.
    void keep();

    /// The first place in the order of samples that none of its cells has.
    int next_order() const { return next_order_; }

    /// The runs that took turns with this one.
    void took_turns(const std::vector<std::string>& others);

    /// Set the end of the run, and write, if there is a cell to keep.
    void finish(std::int64_t compile_ns);

    /// How many cells it has.
    std::size_t size() const { return cells_.size() + stress_.size(); }

    const std::string& run_id() const { return run_id_; }

    /// The whole document, whether or not it goes to a file.
    std::string text() const;

    /// How a command ends that has measured these cells: 1 if one is wrong, else 0. Throws NothingMeasured, saying why, if
    /// there are cells and none has been measured.
    int exit_code() const;

    /// "written: r.json", or that it stays as it was, a line.
    std::string written() const;

private:
    /// A cell as text, so that it is turned into text once, and how it came out.
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
    std::string run_id_;
    Json run_;
    std::vector<Kept> cells_;
    std::vector<std::string> stress_;
    bool has_measured_ = false;  ///< whether a cell holds what may replace an earlier file
    std::size_t passed_ = 0;     ///< cells that are done, of those from before
    bool goes_on_ = false;       ///< whether cells behind them are from before too
    int next_order_ = 0;
    std::chrono::steady_clock::time_point written_at_;
    bool is_written_ = true;
    std::timed_mutex mutex_;  ///< of cells, their texts and what is written
    std::optional<AtSignal> at_signal_;
};

}  // namespace bvhbench
