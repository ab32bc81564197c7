// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "harness/base/json_keys.h"
#include "harness/record/earlier_runs.h"
#include "harness/record/end_of_run.h"
#include "harness/record/journal.h"
#include "harness/record/output.h"
#include "harness/record/record.h"
#include "harness/record/result_text.h"
#include "process/interrupt.h"

namespace bvhbench {

/// Whether a run takes over what earlier runs of its plan have measured.
struct Resuming {
    bool is_asked = false;        ///< --resume
    bool other_commits = false;   ///< --continue-other-commit
    bool retries_failed = false;  ///< --retry-failed: parts with a failed cell are measured again
};

/// Returns the rules for a result file. With `resumes`, a result file may be replaced, because its cells are kept.
OutputRules result_rules(bool force, std::vector<std::string> inputs, bool resumes = false);

/// A result file. While its run goes on, its cells are in a journal beside it (journal.h); the file is written when the run ends, also
/// by a signal, and the journal is removed. Devices and pipes have no journal and are written once. An existing file stays until a cell
/// has been measured.
class ResultFile {
public:
    /// Takes over what a crashed process of the run `resumed_run` has left or, if `resuming` is asked for, what earlier runs have left.
    /// Otherwise throws BadUsage if there is a journal that `force` does not allow to replace. begin() must follow before add().
    ResultFile(Output output, bool force, const Resuming& resuming = {},
               const std::string& resumed_run = {});

    /// The same, begun with the facts of its run.
    ResultFile(Output output, bool force, Json run, const std::string& resumed_run = {});

    /// Writes unwritten cells and ignores errors. Call finish() to see them.
    ~ResultFile();

    /// True if an earlier process of the same run has begun it.
    bool has_begun() const { return has_begun_; }

    /// Begins the run with its facts (harness/record/provenance.h), unless an earlier process has.
    void begin(Json run);

    /// Throws what EarlierRuns::check throws, and leaves all files as they are then.
    void check_earlier(const std::set<std::string>& keys, const Json& run);

    /// If part `key` of the plan is complete, takes over its cells and returns the seconds that it took; 0: unknown.
    std::optional<double> take_part(const std::string& key);

    /// Begins to measure a part. Cells of an earlier process are taken over by pass().
    void begin_part(const std::string& key);
    /// Ends it, after `seconds`.
    void end_part(double seconds);

    /// True if the next `count` cells of the part exist already; they are then skipped. If any of them is missing, drops those that
    /// exist, because all of them will be measured again.
    bool pass(std::size_t count);

    /// Takes over all cells of the part that exist already.
    void take_rest();

    void add(const Cell& cell);
    /// Adds the JSON of a cell that ranks have measured.
    void add(Json cell);
    void add(const StressCell& cell);
    /// Adds the JSON of a cell that cannot be measured.
    void add_impossible(const Json& cell);

    /// Writes the file. Any thread may call it; the signal thread does.
    void keep();

    /// Leaves the journal to another process, which goes on.
    void leave();

    /// True if cells are kept in a journal, so that another process can go on.
    bool has_journal() const { return output_.is_file(); }

    /// Returns the smallest sample order above those of all cells of this run.
    int next_order() const;

    /// Records the end of the run and writes the file if it has a cell worth keeping.
    void finish(const EndOfRun& end);

    /// Returns the number of cells.
    std::size_t size() const { return cells_.size() + stress_.size(); }

    /// Returns "agrees", "failed: why" or "3 results" of the current part.
    std::string outcome_of_part() const;

    std::string run_id() const { return run_.at("id"); }

    /// Returns the whole document, whether or not it is written to a file.
    std::string text() const;

    /// Returns the exit code of a command with these cells: 1 if one is wrong, else 0. Throws NothingMeasured with the first
    /// reason if there are cells and none was measured.
    int exit_code() const;

    /// Returns one line: "written: r.json", or that the file was left unchanged.
    std::string written() const;

private:
    void append(const CellText& cell);
    std::vector<CellText> all_cells() const;
    std::vector<std::string> unfinished_parts() const;
    bool is_worth_writing() const;
    void remove_journal() const;
    void write();

    Output output_;
    Resuming resuming_;
    EarlierRuns earlier_;     ///< parts that were not begun yet
    Json run_;                ///< of this process, or the last one
    bool has_begun_ = false;  ///< whether run_ is of this process, or of one of the same run
    Journal journal_;
    std::string part_;  ///< key of the part that is measured; empty: none, or it has no key
    std::size_t part_begin_ = 0;  ///< index of its first cell
    std::vector<Json> there_;     ///< its cells of earlier processes that pass() has not taken over
    std::vector<CellText> cells_;
    std::vector<std::string> stress_;
    bool has_measured_ = false;  ///< whether there are cells that may replace an existing file
    bool is_left_ = false;       ///< whether files stay as they are
    bool is_written_ = true;
    mutable std::timed_mutex mutex_;  ///< guards all cells and the writing
    std::optional<AtSignal> at_signal_;
};

}  // namespace bvhbench
