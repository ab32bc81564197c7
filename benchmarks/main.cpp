// SPDX-License-Identifier: MIT
#include <iostream>
#include <optional>

#include "benchmarks/cells.h"
#include "benchmarks/host.h"
#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "process/watchdog.h"
#include "scenes/mesh_worker.h"

namespace bvhbench {
namespace {

/// Samples of small scenes take 100 times as long as their device time, so the default of 0.5 s would take a minute.
constexpr const char* min_time = "--benchmark_min_time=0.05";

struct Words {
    CommonOptions common;
    std::string experiment = "smoke", stage;
    bool quick = false;
    std::vector<std::string> google;  ///< words for Google Benchmark

    /// Returns the value of Google's flag --benchmark_NAME=VALUE, "true" if it has none, or "" if it is not given.
    std::string google_value(const std::string& name) const
    {
        const std::string flag = "--benchmark_" + name + '=';
        std::string value;
        for (const std::string& word : google)
            if ((word + '=').starts_with(flag))
                value = word.size() < flag.size() ? "true" : word.substr(flag.size());
        return value;
    }
};

/// Parses the command line. Prints the help and returns false if that is asked for. Throws BadUsage.
bool parse(int argc, char** argv, Words& words)
{
    CLI::App app{"Measure the cells of an experiment, and code of the host, by Google Benchmark.",
                 "bvhbench_benchmarks"};
    app.add_option("--experiment", words.experiment,
                   "a name of `bvhbench list experiments`, or a .json file")
        ->capture_default_str();
    app.add_flag("--quick", words.quick, "fewer scenes");
    app.add_option("--stage", words.stage,
                   "time this stage of each sample; default: the whole sample");
    add_common(app, words.common);
    app.allow_extras();
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        std::cout << app.help() << "\nGoogle Benchmark's options, with " << min_time
                  << " by default:\n"
                  << std::flush;
        benchmark::PrintDefaultHelp();
        return false;
    } catch (const CLI::ParseError& error) {
        throw BadUsage(std::string(error.what()) +
                       "; `bvhbench_benchmarks --help` lists what there is");
    }
    words.google = app.remaining();
    std::string usual = min_time;
    std::vector<char*> google = {argv[0], usual.data()};
    for (std::string& word : words.google)
        google.push_back(word.data());
    int count = static_cast<int>(google.size());
    benchmark::Initialize(&count, google.data());
    if (count > 1)
        throw BadUsage("'" + std::string(google[1]) +
                       "' is no option of this program or of Google Benchmark; --help lists them");
    return true;
}

/// Finds out which cells --benchmark_filter selects, and returns whether it selects any. Its regular expression may be one of
/// another dialect, so a cell may run that is not among them.
bool select_wanted(Plan& plan)
{
    std::string filter = benchmark::GetBenchmarkFilter();
    const bool excludes = filter.starts_with('-');
    if (filter == "all" || filter.empty())
        filter = ".";
    const CellFilter pattern = cell_filter(filter.substr(excludes ? 1 : 0), "--benchmark_filter");
    bool any = false;
    for (PlannedCell& cell : plan.cells)
        any |= cell.is_wanted = passes(pattern, cell.name + "/manual_time") != excludes;
    return any;
}

int run(const Words& words)
{
    limit_host_memory(words.common.memory_limit);
    Plan plan = plan_of(find_experiment(words.experiment, words.quick), words.stage);
    const bool any = select_wanted(plan), lists = words.google_value("list_tests") == "true";
    Outcome outcome;
    std::optional<Cells> cells;
    for (PlannedCell& cell : plan.cells)
        add_benchmark(cell.name, outcome,
                      [&](benchmark::State& state) {
                          if (!cells)
                              cells.emplace(words.common, plan);
                          return cells->run(state, cell, words.stage);
                      })
            ->UseManualTime()
            ->Unit(benchmark::kMicrosecond);
    add_host_benchmarks(outcome);

    const Output out(words.google_value("out"), "--benchmark_out",
                     {.force = words.common.force, .inputs = {words.experiment}});
    if (any && !lists)
        cells.emplace(words.common, plan);  // now, because the output begins with its device
    if (benchmark::RunSpecifiedBenchmarks() == 0)
        throw BadUsage("--benchmark_filter: no benchmark matches '" +
                       benchmark::GetBenchmarkFilter() + "'; --benchmark_list_tests lists them");
    if (!lists && !outcome.differs && !outcome.has_measured)
        throw NothingMeasured("nothing was measured: " + outcome.reason);
    return outcome.differs ? 1 : 0;
}

}  // namespace
}  // namespace bvhbench

int main(int argc, char** argv)
{
    using namespace bvhbench;
    if (is_mesh_worker(argc, argv))
        return mesh_worker_main(argc, argv);
    return exit_code_of([&] {
        Words words;
        return !parse(argc, argv, words) ? 0 : supervised(words.common.time_limit_s, [&] {
            return exit_code_of([&] { return run(words); });
        });
    });
}
