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

/// How the failure of a benchmark begins whose result is wrong.
inline const std::string wrong = "the result is wrong: ";

/// Registers a benchmark. `work` runs its iterations and returns why it has no time, which is then the benchmark's error; empty if
/// it has one.
benchmark::internal::Benchmark* add_benchmark(
    const std::string& name, Outcome& outcome,
    const std::function<std::string(benchmark::State&)>& work);

/// Runs the iterations of `state`: each is one sample by `once`, and its time is that of the stage `stage`, or of the whole
/// sample if that is empty. The mean of each stage becomes a counter such as "sort_ns".
///
/// Returns why a sample failed; empty if none did. A sample fails if `once` throws, if it has no such stage or no time, and after
/// a minute with hardly any device time: Google Benchmark demands iterations until their times add up to
/// --benchmark_min_time, however long that takes.
std::string take_iterations(benchmark::State& state, const std::string& stage,
                            const std::function<std::vector<StageTime>()>& once);

}  // namespace bvhbench
