// SPDX-License-Identifier: MIT
//
// The protocol by which every cell is measured: it is brought to where it can be timed, what it answers then is judged, it is
// sampled interleaved with the others, and judged again. A step that fails makes a cell that says so.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "harness/choice/sampling.h"
#include "harness/record/record.h"
#include "harness/session/session.h"

namespace bvhbench {

/// A cell on its way to being measured. The functions refer to what the caller keeps until the cells are done.
struct Subject {
    Cell cell;
    std::string number = {};  ///< which of the run's cells it is, for the watchdog; empty: of none
    /// One sample; none: there is nothing to time.
    std::function<std::vector<StageTime>()> once = {};
    std::function<void()> judge_again = {};  ///< of what the last sample left; may be empty

    bool is_ready() const
    {
        return once && cell.status == Cell::Status::measured &&
               cell.check.verdict != Check::Verdict::differs;
    }
};

/// What `work` takes, on the host's clock, in nanoseconds.
std::int64_t host_ns(const std::function<void()>& work);

class Engine {
public:
    /// `order` counts samples and goes on.
    Engine(Session& session, SamplingPlan plan, int& order)
        : session_(session), plan_(plan), order_(order)
    {}

    /// Runs `work`, which compiles, runs first and judges, and fills in the cell and `once`. Where it fails, or an earlier
    /// process has given the cell up, the cell says so.
    void settle(Subject& subject, const std::function<void()>& work);

    /// Samples all that are ready, in turn.
    void sample(std::span<Subject> subjects);

    /// The cell has no numbers, and why. What it left in the queue is forgotten.
    void refuse(Subject& subject, Cell::Status status, std::string reason);

private:
    Session& session_;
    SamplingPlan plan_;
    int& order_;
};

}  // namespace bvhbench
