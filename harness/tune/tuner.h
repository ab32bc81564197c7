// SPDX-License-Identifier: MIT
//
// Searches for the tuning values that suit a device: one parameter at a time, each answer checked before it is timed.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "device/queue.h"
#include "device/tuning.h"

namespace bvhbench {

/// The tuned target with one set of values, ready to run repeatedly.
class Trial {
public:
    virtual ~Trial() = default;

    /// Runs it and compares the result with the correct answer. Returns the error; empty if there is none.
    virtual std::string wrong() = 0;

    /// Runs it, blocks until done, and returns the times of its stages.
    virtual std::vector<StageTime> once() = 0;

    /// Returns the parameters whose value has been read so far.
    virtual std::set<const Parameter*> asked() const = 0;
};

/// Makes a trial. Throws what builders and colliders throw, also for values that the device cannot run.
using MakeTrial = std::function<std::unique_ptr<Trial>(const Tuning&)>;

struct SearchOptions {
    int samples = 15;  ///< timed runs per value and comparison
    int warm_up = 2;
    int rounds = 2;       ///< passes over the parameters; ends after one without a gain
    bool is_cpu = false;  ///< kind of device whose defaults the search starts from
};

/// A value that was tried, and the result.
struct TrialResult {
    enum class Verdict {
        current,     ///< the value that the others were compared to
        better,      ///< faster by more than noise in two comparisons: kept
        not_better,  ///< not faster by more than noise, or not the fastest
        not_again,   ///< faster in the first comparison only
        wrong,       ///< gave a wrong answer
        impossible,  ///< failed, or the device cannot run it
    };
    const Parameter* parameter = nullptr;
    uint value = 0;
    Verdict verdict = Verdict::not_better;
    std::string detail = {};  ///< reason, if wrong or impossible
    double median_ns = 0;     ///< of the parameter's stage; 0: not timed
    double ratio = 0;         ///< median relative to that of the value before
};

/// Result of a search; a partial one if the search was stopped.
struct SearchResult {
    Tuning best;                          ///< all parameters: as given, defaults, and kept values
    std::vector<TrialResult> kept;        ///< each parameter once, the last value
    std::vector<TrialResult> tries;       ///< in the order made
    std::set<const Parameter*> searched;  ///< parameters whose search is finished
    double start_ns = 0, best_ns = 0;     ///< medians of whole runs, in the end; 0: not compared
};

/// Called with what is tried next, and with what was found so far.
using SearchNote = std::function<void(const std::string& what, const SearchResult& found)>;

/// True if the median of `times` is lower than that of `than` by more than three standard errors of the difference and by at
/// least one percent.
bool is_faster(const std::vector<double>& times, const std::vector<double>& than);

/// Coordinate descent over the parameters that the trial reads and `wanted` accepts. They start from their defaults; all others
/// keep their value in `start`. For each parameter, all candidates are sampled interleaved with the current value. The fastest
/// correct one is compared with the current value again, and kept if it is faster both times. At the end the kept values are
/// compared with the defaults by whole runs, and dropped if they are not faster.
///
/// Throws Unavailable if the answer is wrong before anything is tuned.
SearchResult search(const MakeTrial& make, const Tuning& start,
                    const std::function<bool(const Parameter&)>& wanted,
                    const SearchOptions& options, const SearchNote& note);

/// Returns a table with one line for each tried value, and the comparison of whole runs.
std::string search_report(const SearchResult& result);

}  // namespace bvhbench
