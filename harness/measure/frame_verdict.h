// SPDX-License-Identifier: MIT
#pragma once

#include "harness/judge/pair_counts.h"
#include "harness/measure/collide.h"
#include "harness/measure/frame_oracle.h"

namespace bvhbench {

/// Judges what pipelines find in a frame by the right pairs and contacts, which oracles compute on other cores.
class FrameVerdict {
public:
    /// `frame` must outlive this object.
    FrameVerdict(Session& session, const FrameOfPipelines& frame)
        : session_(session), frame_(frame), oracle_(frame.input, frame.file_faces, frame.note)
    {}

    /// Starts on the right pairs. Nothing may be timed before wait().
    void begin(const ColliderChoice& choice) { oracle_.begin(choice); }
    void wait() const { oracle_.wait(); }

    /// Throws if the host lacks memory for a library's trees and for its pairs, which the oracle has counted. The pairs are stored
    /// twice, in lists that grow by doubling.
    void require_memory(const ColliderChoice& choice);

    /// Judges what the pipeline found in its last frame. Writes the verdict and the counters of errors to the cell, and lists that
    /// are wanted, or wrong, to `found`.
    void judge(Pipeline& pipeline, Cell& cell, Found& found);

private:
    class FoundList;

    void judge_pairs(Pipeline& pipeline, Cell& cell, Found& found);
    void judge_pairs_by_list(const Pipeline& pipeline, const Expected& expected, Cell& cell,
                             Found& found) const;
    void judge_first(const Pipeline& pipeline, Cell& cell, Found& found);
    void judge_contacts(const Pipeline& pipeline, Cell& cell, Found& found);

    Session& session_;
    const FrameOfPipelines& frame_;
    FrameOracle oracle_;
};

/// Compares what was found with what is right. Returns what is missed and what is false, and writes both to the cell's counters
/// missed_count and false_count, of whose names `of` is a part.
Differences count_errors(const PairList& found, const PairList& right, Cell& cell,
                         const std::string& of = {});

}  // namespace bvhbench
