// SPDX-License-Identifier: MIT
//
// The search for what suits a device: one parameter after the other, each answer checked before its time counts.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "device/queue.h"
#include "device/tuning.h"

namespace bvhbench {

/// What is tuned, made with one set of values, ready to be run again and again.
class Trial {
public:
    virtual ~Trial() = default;

    /// Run it and hold what it leaves to the right answer. Why it is wrong; empty if it is right.
    virtual std::string wrong() = 0;

    /// Run it, wait, and say what its stages took.
    virtual std::vector<StageTime> once() = 0;

    /// The parameters whose value anybody has asked for until now.
    virtual std::set<const Parameter*> asked() const = 0;
};

/// Makes one. Throws what builders and colliders throw, for values that the device cannot do too.
using MakeTrial = std::function<std::unique_ptr<Trial>(const Tuning&)>;

struct SearchOptions {
    int samples = 15;  ///< timed runs a value and turn
    int warm_up = 2;
    int rounds = 2;       ///< through all parameters, the second only if the first found something
    bool is_cpu = false;  ///< whose defaults values start from
};

/// A value that was tried, and what came of it.
struct Tried {
    enum class Verdict {
        current,     ///< the value that the others were held against
        better,      ///< by more than noise, and once more in a second comparison: kept
        not_better,  ///< or not by more than noise
        not_again,   ///< better, but not in the second comparison
        wrong,       ///< gave a wrong answer
        impossible,  ///< the device cannot do it, or it failed
    };
    const Parameter* parameter = nullptr;
    uint value = 0;
    Verdict verdict = Verdict::not_better;
    std::string detail;    ///< of what is wrong or impossible: why
    double median_ns = 0;  ///< of the parameter's stage; 0: not timed
    double ratio = 0;      ///< of that to the current value's
};

/// A value that was kept.
struct Kept {
    const Parameter* parameter = nullptr;
    uint value = 0;
    double ratio = 1;  ///< of its median to that of the value before it
};

/// What a search has found, so far if it was stopped.
struct SearchResult {
    Tuning best;               ///< of all parameters: as they were, defaults, and what was kept
    std::vector<Kept> kept;    ///< each parameter once
    std::vector<Tried> tries;  ///< in the order made
    std::set<const Parameter*> searched;  ///< parameters that are settled, be they kept or left
    double start_ns = 0, best_ns = 0;  ///< medians of a whole run, compared in the end; 0: not done
};

/// Whether times of samples are lower than others by more than both scatter: three standard errors of the difference of
/// their medians, and at least one part in a hundred.
bool is_faster(const std::vector<double>& times, const std::vector<double>& than);

/// Coordinate descent over the parameters that the trial asks for and `wanted` says yes to. They start from their
/// defaults, others stay as `start` has them. Of each, all candidates are sampled beside the current value, interleaved;
/// the fastest right one is compared with the current value once more, and kept if it is faster both times. In the end
/// all that was kept is held against the defaults by whole runs, and given up if it is not faster. `result` is true
/// whenever `note` is called.
///
/// Throws Unavailable if what it starts from is already wrong.
void search(const MakeTrial& make, const Tuning& start,
            const std::function<bool(const Parameter&)>& wanted, const SearchOptions& options,
            const std::function<void(const std::string&)>& note, SearchResult& result);

/// What was tried, a line each, and what is left of it in the end.
std::string search_report(const SearchResult& result);

}  // namespace bvhbench
