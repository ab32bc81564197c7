// SPDX-License-Identifier: MIT
#include "benchmarks/iterations.h"

#include <gtest/gtest.h>

#include "geometry/error.h"

namespace bvhbench {
namespace {

using Repetition = benchmark::BenchmarkReporter::Run;
using Once = std::function<std::vector<StageTime>()>;

class Keep final : public benchmark::BenchmarkReporter {
public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Repetition>& runs) override
    {
        for (const Repetition& run : runs)
            if (run.run_type == Repetition::RT_Iteration)
                kept.push_back(run);
    }
    std::vector<Repetition> kept;
};

/// Runs `once` as a benchmark of four iterations and returns each of its repetitions.
std::vector<Repetition> repetitions(const Once& once, const std::string& stage = {}, int count = 1)
{
    benchmark::ClearRegisteredBenchmarks();
    Outcome outcome;
    add_benchmark("fake", outcome,
                  [&](benchmark::State& state) { return take_iterations(state, stage, once); })
        ->UseManualTime()
        ->Iterations(4)
        ->Repetitions(count);
    Keep reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
    return reporter.kept;
}

double time_ns(const Repetition& run)
{
    return 1e9 * run.real_accumulated_time / static_cast<double>(run.iterations);
}

/// Sample k has 1000 k ns of bounds and, after a gap of 100 ns, 500 ns of a hierarchy.
Once known_stages()
{
    return [k = std::int64_t{0}]() mutable {
        ++k;
        const StageTime bounds{.stage = "bounds", .span_ns = 1000 * k, .launches = 1};
        const StageTime hierarchy{
            .stage = "hierarchy", .span_ns = 500, .launches = 1, .start_ns = 1000 * k + 100};
        return std::vector<StageTime>{bounds, hierarchy};
    };
}

TEST(Iterations, EachIsOneSampleFromItsFirstStartToItsLastEnd)
{
    const std::vector<Repetition> runs = repetitions(known_stages());
    ASSERT_EQ(runs.size(), 1u);
    EXPECT_EQ(runs[0].iterations, 4);
    EXPECT_NEAR(time_ns(runs[0]), 2500 + 100 + 500, 1e-6);
    EXPECT_NEAR(runs[0].counters.at("bounds_ns").value, 2500, 1e-6);
    EXPECT_NEAR(runs[0].counters.at("hierarchy_ns").value, 500, 1e-6);
}

TEST(Iterations, HaveTheTimeOfTheStageAskedFor)
{
    EXPECT_NEAR(time_ns(repetitions(known_stages(), "bounds").at(0)), 2500, 1e-6);
    const Repetition run = repetitions(known_stages(), "sort").at(0);
    EXPECT_TRUE(run.error_occurred);
    EXPECT_EQ(run.error_message,
              "a sample has no stage 'sort' that takes time; its stages are: bounds hierarchy");
}

TEST(Iterations, WithoutTimeOrAfterAFailureAreAnError)
{
    const Repetition idle =
        repetitions([] { return std::vector<StageTime>{{.stage = "hierarchy"}}; }).at(0);
    EXPECT_TRUE(idle.error_occurred);
    EXPECT_NE(idle.error_message.find("takes no time"), std::string::npos);
    int calls = 0;
    // The third repetition fails.
    const Once fails = [&, once = known_stages()] {
        if (++calls > 9)
            throw Unavailable("no more memory");
        return once();
    };
    const std::vector<Repetition> runs = repetitions(fails, {}, 3);
    ASSERT_EQ(runs.size(), 3u);
    EXPECT_FALSE(runs[1].error_occurred);
    EXPECT_TRUE(runs[2].error_occurred);
    EXPECT_EQ(runs[2].error_message, "no more memory");
}

}  // namespace
}  // namespace bvhbench
