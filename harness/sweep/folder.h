// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/file_lock.h"
#include "harness/record.h"
#include "harness/sweep/units.h"

namespace bvhbench {

/// What a sweep leaves behind, and knows itself again by when it goes on:
///
///     plan.json            of which units it is, by which programs, on which device
///     experiments/ID.json  what the process of a unit runs
///     cells/ID.json        what came of it, a result file; there in full or not finished
///     NAME.json            all of them, merged; of a shard NAME-IofN.json
///
/// A unit's ID is the hash of what is measured, by which program and on which device.
class SweepFolder {
public:
    /// Throws BadUsage if the folder holds another sweep, or cells on another device or, unless those are to be kept, by
    /// another program; Unavailable if it cannot be written or another process is at work in it.
    SweepFolder(std::filesystem::path folder, const Sweep& sweep, bool together,
                const std::vector<SweepUnit>& units, const Shard& shard, const RunFacts& facts,
                bool keeps_other_commit);

    /// The result file of the unit, whichever program measured it. Nothing if it is not done.
    std::optional<std::filesystem::path> done(const SweepUnit& unit) const;

    /// Where this program puts them.
    std::filesystem::path cell_file(const SweepUnit& unit) const;
    std::filesystem::path experiment_file(const SweepUnit& unit) const;
    std::filesystem::path result_file() const { return result_; }

    /// Remove what is left of a unit that is not done, and write its experiment.
    void begin(const SweepUnit& unit) const;

    /// What is said of an earlier program, whose cells count too; empty if there is none.
    const std::string& note() const { return note_; }

private:
    std::string id(const SweepUnit& unit, const std::string& program) const;
    std::filesystem::path cell_file(const SweepUnit& unit, const std::string& program) const;
    void check_plan(const Json& plan, const std::vector<SweepUnit>& units, bool keeps_other_commit);
    Json plan_of(const Sweep& sweep, const std::vector<SweepUnit>& units) const;

    std::filesystem::path folder_, result_;
    std::string device_;
    std::vector<std::string> programs_;  ///< this one first
    std::optional<FileLock> lock_, shard_lock_;
    std::string note_;
};

/// What is in a unit's file, if its process has written the end of its run. Throws Unavailable for what is no result file.
std::optional<Document> finished_document(const std::filesystem::path& file);

/// Whether a cell of it failed.
bool has_failed(const Document& document);

/// Which program it is, in words that another one does not have: with changes that are in no commit, by its own bytes too.
std::string program_words(const RunFacts& facts);

/// The same of the device, with what it is tuned to.
std::string device_words(const RunFacts& facts);

}  // namespace bvhbench
