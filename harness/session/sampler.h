// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "device/queue.h"
#include "harness/choice/sampling.h"
#include "harness/record/record.h"
#include "harness/session/turns.h"

namespace bvhbench {

/// One thing to sample.
struct Timed {
    std::string name;
    std::function<std::vector<StageTime>()> once;  ///< run it, wait, and say what its stages took
};

/// What came of it.
struct Taken {
    std::vector<Sample> samples;  ///< in the order taken, warm-up left out
    std::string failure;          ///< why it stopped early; empty if it did not
    Stopped stopped = Stopped::not_sampled;
};

/// Sample each of `cells` as `plan` says, all of them interleaved: in rounds, each of which takes every cell once, in an
/// order drawn anew, so that drift of the machine hits them alike. One that fails is not run again; the others go on.
///
/// `calibrate` runs a fixed piece of work and says how long it took, in nanoseconds: before the first sample, after every
/// `calibrate_every` of them, and after the last. Samples are told what it took around them, and are marked `drifted` where
/// that is further from its median than `drift_limit`. Marked samples are kept; under a target they do not count. If it
/// throws, or there is none, nothing is marked.
///
/// With `turns` each round is a turn among other runs.
///
/// `order` counts the run's samples, warm-up included, and goes on from call to call.
std::vector<Taken> take_samples(std::span<const Timed> cells, const SamplingPlan& plan, int& order,
                                const std::function<std::int64_t()>& calibrate = {},
                                Turns* turns = nullptr);

/// The same by number alone.
inline std::vector<Taken> take_samples(std::span<const Timed> cells, int samples, int warm_up,
                                       int& order)
{
    return take_samples(cells, {.samples = samples, .warm_up = warm_up}, order);
}

/// The value a `fraction` of the sorted values lies below, between neighbours in proportion. 0 for none.
double quantile(std::vector<double> values, double fraction);

/// Nanoseconds of all stages of a sample, by which samples are compared: on the device from the first start to the last end;
/// stages on the host are added.
double whole_ns(const std::vector<StageTime>& stages);

}  // namespace bvhbench
