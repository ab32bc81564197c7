// SPDX-License-Identifier: MIT
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <vector>

#include "device/queue.h"

namespace bvhbench {

/// What became of the benchmarks so far.
struct Outcome {
    bool differs = false;       ///< whether a result was wrong
    bool has_measured = false;  ///< whether a benchmark has a time
    std::string reason;         ///< why the last benchmark without a time has none
};

/// Runs the iterations of `state`: each is one sample by `once`, and its time is that of the stage `stage`, or of the whole
/// sample if that is empty. The mean of each stage becomes a counter such as "sort_ns". `slowed` is the name by which
/// BVHBENCH_SLOW lengthens stages (harness/base/test_hooks.h).
///
/// Returns why a sample failed, which is then the error of `state`; empty if none did. A sample fails if `once` throws, if it has
/// no such stage or no time, and after a minute with hardly any device time: Google Benchmark demands iterations until their
/// times add up to --benchmark_min_time, however long that takes.
std::string take_iterations(benchmark::State& state, const std::string& slowed,
                            const std::string& stage,
                            const std::function<std::vector<StageTime>()>& once);

/// Gives a benchmark whose iterations did not begin an error. It counts them all the same: Google Benchmark ends the program if
/// one repetition has fewer than another.
void fail(benchmark::State& state, const std::string& reason);

}  // namespace bvhbench
