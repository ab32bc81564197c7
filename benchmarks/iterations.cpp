// SPDX-License-Identifier: MIT
#include "benchmarks/iterations.h"

#include <chrono>
#include <map>

#include "geometry/error.h"
#include "harness/base/failure.h"
#include "harness/base/test_hooks.h"
#include "harness/session/sampler.h"

namespace bvhbench {
namespace {

double timed_ns(const std::vector<StageTime>& stages, const std::string& stage)
{
    std::string names;
    double ns = stage.empty() ? whole_ns(stages) : -1;
    for (const StageTime& one : stages) {
        names += ' ' + one.stage;
        if (one.stage == stage)
            ns = static_cast<double>(one.elapsed_ns());
    }
    if (ns < 0)
        throw BadUsage("there is no stage '" + stage + "' in a sample; its stages are:" + names);
    if (ns == 0)
        throw BadUsage("a sample takes no time: it launches nothing, or the clock is too coarse");
    return ns;
}

}  // namespace

std::string take_iterations(benchmark::State& state, const std::string& slowed,
                            const std::string& stage,
                            const std::function<std::vector<StageTime>()>& once)
{
    const auto start = std::chrono::steady_clock::now();
    std::map<std::string, double> sums;
    double device_s = 0;
    const auto take = [&] {
        std::vector<StageTime> stages = once();
        slow_down(stages, slowed);
        const double seconds = 1e-9 * timed_ns(stages, stage);
        state.SetIterationTime(seconds);
        for (const StageTime& one : stages)
            sums[one.stage + "_ns"] += static_cast<double>(one.elapsed_ns());
        device_s += seconds;
        const std::chrono::duration<double> host = std::chrono::steady_clock::now() - start;
        if (host.count() > 60 && device_s < host.count() / 50)
            throw Unavailable("a minute of samples has " + std::to_string(device_s) +
                              " s of device time; a smaller --benchmark_min_time needs fewer");
    };
    for (auto _ : state) {
        if (const std::string failure = reason_of_failure(take); !failure.empty()) {
            state.SkipWithError(failure.c_str());
            return failure;
        }
    }
    for (const auto& [name, sum] : sums)
        state.counters[name] = sum / static_cast<double>(state.iterations());
    return {};
}

void fail(benchmark::State& state, const std::string& reason)
{
    for (auto _ : state) {
        state.SkipWithError(reason.c_str());
        break;
    }
}

}  // namespace bvhbench
