// SPDX-License-Identifier: MIT
//
// The protocol that measures every cell: prepare it (compile, run once, judge the result), sample it interleaved with the others,
// judge it again. A step that fails marks the cell as failed or skipped, with the reason.
#pragma once

#include <chrono>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "harness/base/terminal.h"
#include "harness/choice/sampling.h"
#include "harness/measure/contest.h"
#include "harness/record/record.h"
#include "harness/session/session.h"

namespace bvhbench {

/// A cell and the functions that measure it. They may refer to objects of the caller, which must outlive the measurement.
struct Measurement {
    Cell cell;
    std::string number = {};  ///< path of the cell within the run, for the watchdog; may be empty
    /// Runs one sample and returns its stages; empty if there is nothing to time.
    std::function<std::vector<StageTime>()> once = {};
    std::function<void()> judge_again = {};  ///< judges the result of the last sample; may be empty
    /// For samples that begin on the host: copy the vertices to the device, and the answer to the host. Empty where nothing is copied.
    std::function<void()> upload = {}, read_back = {};
    std::string no_copies = {};  ///< why its samples cannot begin on the host; empty if they can
    std::vector<StageTime> stages_before = {};  ///< stages of the last run before the samples

    bool is_ready() const
    {
        return once && cell.status == Cell::Status::measured &&
               cell.check.verdict != Check::Verdict::differs;
    }
};

/// Why no sample of a method from outside begins on the host.
inline constexpr const char* no_copies_of_outside =
    "a method from outside gets its vertices through a file, which is no upload of its own";

inline double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Runs `work` and returns its duration in nanoseconds of the host's clock. Throws BadClock if that is less than 0.
std::int64_t host_ns(const std::function<void()>& work);

class Engine {
public:
    /// `order` is the number of the next sample; each sample increments it. `note` is called during sampling; may be empty.
    Engine(Session& session, SamplingPlan plan, int& order, Note note = {})
        : session_(session), plan_(std::move(plan)), order_(order), note_(std::move(note))
    {}

    /// Runs `work`, which compiles, runs and judges the cell for the first time, and fills in `cell` and `once`. Marks the cell
    /// as failed or skipped if `work` throws or if an earlier process of this run gave the cell up.
    void prepare(Measurement& measurement, const std::function<void()>& work);

    /// In a race, takes the first sample of a cell that is ready, and runs the best so far once more beside it, because the speed
    /// of a machine changes. Returns true (drop the cell) if this sample and the run before it are both far behind the best
    /// (`far_behind`, session/race.h). If only the sample is, takes one more.
    bool sample_first(Measurement& measurement, Contest& contest);

    /// Samples all cells that are ready, interleaved, with caches of each kind that the plan names, and judges each again, except
    /// those that lost a race. Returns a cell for each of them and kind of caches; one that fails once has failed with all.
    std::vector<Cell> sample(std::span<Measurement> measurements);

    /// Marks the cell with `status` and `reason`, drops its samples, and discards its queued launches.
    void refuse(Cell& cell, Cell::Status status, std::string reason);

private:
    void sample(std::span<Measurement> measurements, Caches caches, std::span<Cell> cells);
    std::vector<StageTime> from_host(Measurement& measurement);
    void count_joules(Measurement& measurement, Cell& cell);
    SamplingFacts facts_of(Stopped stopped, Caches caches) const;
    std::vector<StageTime> run_once(Measurement& measurement);
    double slower_now();
    void tell(int rounds, double before_s, double sampling_s) const;

    Session& session_;
    SamplingPlan plan_;
    int& order_;
    Note note_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    Measurement* ahead_ = nullptr;  ///< the best of those that were looked at
    double ahead_ns_ = 0;           ///< its least time
    std::int64_t wall_ns_ = 0;      ///< of the last sample that began on the host
};

}  // namespace bvhbench
