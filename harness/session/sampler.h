// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "device/queue.h"
#include "harness/choice/sampling.h"
#include "harness/record/record.h"
#include "harness/session/other_processes.h"
#include "harness/session/turns.h"

namespace bvhbench {

/// One cell to sample.
struct CellToSample {
    std::string name;
    /// Runs it, waits, returns its stages' times. Throws BadClock if they cannot be true: the sample is then dropped.
    std::function<std::vector<StageTime>()> once;
    std::vector<Sample> earlier = {};  ///< samples that it already has, which count
    double bytes = 0;                  ///< bytes held, for a race for memory
    /// Returns how long the last `once` took on the host's clock, in nanoseconds; may be empty.
    std::function<std::int64_t()> wall_ns = {};
};

/// The samples of one cell.
struct CellSamples {
    std::vector<Sample> samples;  ///< in the order taken, without warm-up
    std::string failure;          ///< why sampling failed; empty if it did not
    Stopped stopped = Stopped::not_sampled;
    int dropped = 0;  ///< samples whose times could not be true
};

/// Samples the cells interleaved, according to `plan`. Each round takes every cell once, in a new random order, so that drift of
/// the machine affects all cells alike. A cell that fails is not run again; the others continue. A cell fails as well if more than
/// one sample, and more than a tenth, had times that cannot be true.
///
/// `calibrate` runs a fixed piece of work and returns its nanoseconds. It is called before the first sample, after every
/// `calibrate_every` samples, and after the last. Each sample stores the mean of the calibrations around it, and is marked
/// `drifted` if one of them is off their median by more than `drift_limit`. Marked samples are kept, but do not count towards the
/// target `until`. If `calibrate` throws or is empty, nothing is marked.
///
/// In a race (race.h) a cell that another one beats stops after a round. Earlier samples were not interleaved, so they do not decide
/// it, except that a cell with one of them as fast as the best stays.
///
/// With `turns`, each round is one turn among other runs. `others` looks for other processes before each round.
///
/// `order` is the number of samples of the run so far, warm-up included; it is increased.
std::vector<CellSamples> take_samples(std::span<const CellToSample> cells, const SamplingPlan& plan,
                                      int& order,
                                      const std::function<std::int64_t()>& calibrate = {},
                                      Turns* turns = nullptr, OtherProcesses* others = nullptr);

/// Returns the error as a sentence that offers the host's clock if the device's is wrong.
std::string clock_sentence(const BadClock& error);

/// Returns the quantile `fraction` of the values, interpolated linearly between neighbours; 0 without values.
double quantile(std::vector<double> values, double fraction);

/// Returns the whole time of a sample in nanoseconds, by which samples are compared: on the device from the first start to the
/// last end; with host stages, the sum of all stages.
double whole_ns(const std::vector<StageTime>& stages);

}  // namespace bvhbench
