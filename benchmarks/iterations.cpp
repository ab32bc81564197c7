// SPDX-License-Identifier: MIT
#include "benchmarks/iterations.h"

#include <chrono>
#include <map>

#include "geometry/error.h"
#include "harness/base/failure.h"
#include "harness/session/sampler.h"

namespace bvhbench {

benchmark::internal::Benchmark* add_benchmark(
    const std::string& name, Outcome& outcome,
    const std::function<std::string(benchmark::State&)>& work)
{
    return benchmark::RegisterBenchmark(name.c_str(), [&outcome, work](benchmark::State& state) {
        const std::string failure = work(state);
        outcome.has_measured |= failure.empty();
        outcome.differs |= failure.starts_with(wrong);
        if (failure.empty())
            return;
        outcome.reason = failure;
        // Google Benchmark ends the program if one repetition has fewer iterations than another: they must have begun.
        if (state.iterations() == 0)
            state.KeepRunning();
        state.SkipWithError(failure.c_str());
    });
}

std::string take_iterations(benchmark::State& state, const std::string& stage,
                            const std::function<std::vector<StageTime>()>& once)
{
    const auto start = std::chrono::steady_clock::now();
    std::map<std::string, double> sums;
    double device_s = 0;
    const auto take = [&] {
        const std::vector<StageTime> stages = once();
        std::string names;
        double ns = stage.empty() ? whole_ns(stages) : 0;
        for (const StageTime& one : stages) {
            const auto own_ns = static_cast<double>(one.elapsed_ns());
            sums[one.stage + "_ns"] += own_ns;
            names += ' ' + one.stage;
            ns = one.stage == stage ? own_ns : ns;
        }
        if (ns == 0)
            throw BadUsage(
                "a sample " +
                (stage.empty() ? "takes no time" : "has no stage '" + stage + "' that takes time") +
                "; its stages are:" + names);
        state.SetIterationTime(1e-9 * ns);
        device_s += 1e-9 * ns;
        const std::chrono::duration<double> host = std::chrono::steady_clock::now() - start;
        if (host.count() > 60 && device_s < host.count() / 50)
            throw Unavailable("a minute of samples has " + std::to_string(device_s) +
                              " s of device time; a smaller --benchmark_min_time needs fewer");
    };
    for (auto _ : state)
        if (const std::string failure = reason_of_failure(take); !failure.empty())
            return failure;
    for (const auto& [name, sum] : sums)
        state.counters[name] = sum / static_cast<double>(state.iterations());
    return {};
}

}  // namespace bvhbench
