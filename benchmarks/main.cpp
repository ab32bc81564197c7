// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iostream>
#include <optional>

#include "benchmarks/cells.h"
#include "benchmarks/host.h"
#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/base/build_info.h"
#include "harness/base/test_hooks.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "harness/session/watchdog.h"
#include "scenes/mesh_worker.h"

namespace bvhbench {
namespace {

/// Samples of small scenes take 100 times as long as their device time, so the default of 0.5 s would take a minute.
constexpr const char* min_time = "--benchmark_min_time=0.05";

struct Words {
    CommonOptions common;
    std::string experiment = "smoke", stage;
    bool quick = false;
    std::vector<char*> google;  ///< argv of Google Benchmark

    /// Returns the value of Google's flag --benchmark_NAME=VALUE, "true" if it has none, or `usual` if it is not given.
    std::string google_value(const std::string& name, const std::string& usual) const
    {
        std::string value = usual;
        for (const std::string word : google)
            if (const std::string flag = "--benchmark_" + name; word == flag)
                value = "true";
            else if (word.starts_with(flag + '='))
                value = word.substr(flag.size() + 1);
        return value;
    }
};

/// Parses the command line. Prints the help and returns false if that is asked for. Throws BadUsage.
bool parse(int argc, char** argv, Words& words)
{
    words.google = {argv[0], const_cast<char*>(min_time)};
    std::vector<const char*> ours = {argv[0]};
    for (int k = 1; k < argc; ++k)
        if (std::string_view(argv[k]).starts_with("--benchmark_"))
            words.google.push_back(argv[k]);
        else
            ours.push_back(argv[k]);
    CLI::App app{"Measure the cells of an experiment, and code of the host, by Google Benchmark.",
                 "bvhbench_benchmarks"};
    app.add_option("--experiment", words.experiment,
                   "a name of `bvhbench list experiments`, or a .json file")
        ->capture_default_str();
    app.add_flag("--quick", words.quick, "fewer scenes");
    app.add_option("--stage", words.stage,
                   "time this stage of each sample; default: the whole sample");
    add_common(app, words.common);
    try {
        app.parse(static_cast<int>(ours.size()), ours.data());
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
    int count = static_cast<int>(words.google.size());
    std::vector<char*> google = words.google;
    benchmark::Initialize(&count, google.data());
    if (count > 1)
        throw BadUsage("'" + std::string(google[1]) +
                       "' is no option of Google Benchmark; --help lists them, as --NAME=VALUE");
    return true;
}

/// Returns the names that --benchmark_filter selects. Its regular expression may be one of another dialect, so a cell may run that
/// is not among them.
std::set<std::string> selected(const Plan& plan)
{
    std::string filter = benchmark::GetBenchmarkFilter();
    const bool excludes = filter.starts_with('-');
    if (filter == "all" || filter.empty())
        filter = ".";
    const CellFilter pattern = cell_filter(filter.substr(excludes ? 1 : 0), "--benchmark_filter");
    std::set<std::string> names;
    for (const PlannedCell& cell : plan.cells)
        if (passes(pattern, cell.name + "/manual_time") != excludes)
            names.insert(cell.name);
    return names;
}

void add_context(const Session& session)
{
    benchmark::AddCustomContext("device", session.device().name());
    benchmark::AddCustomContext("platform", session.device().platform());
    benchmark::AddCustomContext("bvhbench_version", build_info.version);
    benchmark::AddCustomContext("bvhbench_commit", build_info.commit);
    for (const auto& [name, value] : test_hooks())
        benchmark::AddCustomContext(name, value);
}

int run(const Words& words)
{
    limit_host_memory(words.common.memory_limit);
    const Plan plan = plan_of(find_experiment(words.experiment, words.quick), words.stage);
    const std::set<std::string> wanted = selected(plan);
    const bool lists = words.google_value("list_tests", "false") == "true";
    Outcome outcome;
    std::optional<Session> session;
    std::optional<Cells> cells;
    const auto open = [&] {
        session.emplace(words.common);
        cells.emplace(*session, plan, wanted);
    };
    for (const PlannedCell& cell : plan.cells)
        benchmark::RegisterBenchmark(cell.name.c_str(),
                                     [&](benchmark::State& state) {
                                         if (!cells)
                                             open();
                                         cells->run(state, cell, words.stage, outcome);
                                     })
            ->UseManualTime()
            ->Unit(benchmark::kMicrosecond);
    register_host_codes(outcome);
    register_host_contacts(outcome);
    register_host_readers(outcome);

    const Output out(words.google_value("out", ""), "--benchmark_out",
                     {.force = words.common.force, .inputs = {words.experiment}});
    if (!lists && !wanted.empty()) {
        open();
        add_context(*session);
    }
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
