// SPDX-License-Identifier: MIT
#include "harness/sampler.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>

#include "harness/failure.h"
#include "harness/interrupt.h"

namespace bvhbench {
namespace {

/// The samples are kept by the cells themselves, so there is nothing left to report.
class SilentReporter : public benchmark::BenchmarkReporter {
public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>&) override {}
};

/// Google Benchmark takes its settings as a command line, and from the environment where that is silent.
void set_up_benchmark()
{
    std::array<std::string, 5> words = {"bvhbench", "--benchmark_enable_random_interleaving=true",
                                        "--benchmark_out=", "--benchmark_list_tests=false",
                                        "--benchmark_min_warmup_time=0"};
    std::array<char*, words.size() + 1> argv{};
    for (std::size_t i = 0; i < words.size(); ++i)
        argv[i] = words[i].data();
    int argc = static_cast<int>(words.size());
    benchmark::Initialize(&argc, argv.data());
}

double seconds_of(const std::vector<StageTime>& stages)
{
    std::int64_t ns = 0;
    for (const StageTime& stage : stages)
        ns += stage.elapsed_ns();
    return static_cast<double>(ns) * 1e-9;
}

/// Take one sample of `cell`, or note why not.
///
/// Nothing is skipped by State::SkipWithError: Google Benchmark 1.7 aborts the program when only some of a
/// benchmark's repetitions were. One that need not run any more takes no time instead.
void sample_once(benchmark::State& state, const Timed& cell, Taken& taken, int order)
{
    for ([[maybe_unused]] auto iteration : state) {
        std::vector<StageTime> stages;
        if (!is_interrupted() && taken.failure.empty()) {
            taken.failure = reason_of_failure([&] { stages = cell.once(); });
            if (taken.failure.empty())
                taken.samples.push_back({order, stages});
        }
        state.SetIterationTime(seconds_of(stages));
    }
}

}  // namespace

std::vector<Taken> take_samples(std::span<const Timed> cells, int samples, int warm_up, int& order)
{
    std::vector<Taken> taken(cells.size());
    if (cells.empty())
        return taken;
    set_up_benchmark();
    for (std::size_t i = 0; i < cells.size(); ++i)
        benchmark::RegisterBenchmark(
            cells[i].name.c_str(),
            [&, i](benchmark::State& state) { sample_once(state, cells[i], taken[i], order++); })
            ->Iterations(1)
            ->Repetitions(warm_up + samples)
            ->UseManualTime();
    SilentReporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter, "all");
    benchmark::ClearRegisteredBenchmarks();
    throw_if_interrupted();

    for (Taken& cell : taken) {
        const auto thrown_away =
            std::min<std::size_t>(cell.samples.size(), static_cast<std::size_t>(warm_up));
        cell.samples.erase(cell.samples.begin(),
                           cell.samples.begin() + static_cast<std::ptrdiff_t>(thrown_away));
    }
    return taken;
}

}  // namespace bvhbench
