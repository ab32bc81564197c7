// SPDX-License-Identifier: MIT
#include "harness/session/session.h"

#include <re2/re2.h>

#include <filesystem>
#include <iostream>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/base/failure.h"
#include "harness/session/sampler.h"
#include "harness/session/tuning_file.h"
#include "process/watchdog.h"

namespace bvhbench {

SceneLibrary scene_library(const CommonOptions& common)
{
    SceneLibrary library;
    library.data = common.data.empty() ? environment("BVHBENCH_DATA") : common.data;
    library.doubles = doubles_called(common.doubles);
    library.weld = common.weld;
    library.tell = [](const std::string& line) { std::cerr << line << '\n'; };
    return library;
}

Device open_device_of(const CommonOptions& common)
{
    if (!common.kernels.empty() && !std::filesystem::is_directory(common.kernels))
        throw Unavailable("--kernels: there is no folder '" + common.kernels + "'");
    Device device =
        open_device(common.device,
                    common.kernels.empty() ? Sources::preferred() : Sources::tree(common.kernels));
    if (device_words(common.device).empty() && !device.is_cpu())
        std::cerr << "bvhbench: device " << device.name()
                  << ", because none was named; --device cpu takes the processor\n";
    // Sets the limit again, so that it allows for the stacks of the driver's threads. Only little of these becomes resident.
    limit_host_memory(common.memory_limit);
    if (common.memory_limit > 0)
        device.memory_limit = common.memory_limit;
    device.host_clock = common.clock == "host";
    const auto [file, origin] = tuning_file_for(device, tuning_folder(common.tuning));
    device.tuning = tuning_of(file, device, origin);
    return device;
}

Session::Session(Device device, SceneLibrary library)
    : device_(std::move(device)), library_(std::move(library))
{}

Session::Session(const CommonOptions& common)
    : cache_(std::in_place), device_(open_device_of(common)), library_(scene_library(common))
{
    if (common.verbose)
        std::cerr << "device: " << device_.platform() << '/' << device_.name()
                  << "\nkernels: " << device_.sources.origin()
                  << "\ntuning: " << device_.tuning.origin() << '\n';
}

/// Keeps the address of the queue, because existing trees refer to it.
void Session::renew_queue()
{
    Queue fresh(device_);
    std::swap(*queue_, fresh);
}

Builder& Session::builder(const BuilderChoice& choice, Operation operation)
{
    for (const Made& made : builders_)
        if (made.choice == choice && made.operation == operation)
            return *made.builder;
    builders_.push_back({choice, operation, make_builder(choice, programs_)});
    return *builders_.back().builder;
}

void Session::set_caches(Caches caches)
{
    if (caches == Caches::cold && !cache_flush_)
        cache_flush_.emplace(programs_, queue());
    caches_ = caches;
}

void Session::take_turns(const std::string& path, const std::string& id)
{
    if (path.empty())
        return;
    std::string file;
    int count = 0;
    if (!RE2::FullMatch(path, "(.+):(\\d+)", &file, &count) || count < 2 || count > 64)
        throw BadUsage(
            "--turns names a file and how many runs take turns by it, as out/turns:2, not '" +
            path + "'");
    turns_.emplace(file, count, id);
}

EndOfRun Session::end_of_run() const
{
    EndOfRun end{.compile_ns = programs_.compile_ns(), .other_processes = other_processes_.mean()};
    if (turns_)
        end.turns_with.assign(turns_->others().begin(), turns_->others().end());
    return end;
}

std::vector<StageTime> Session::timed(const std::function<std::vector<StageTime>()>& once)
{
    try {
        queue().check_times();  // of what ran before
    } catch (const BadClock&) {
    }
    std::vector<StageTime> stages = once();
    queue().check_times();
    return stages;
}

void Session::check_clocks()
{
    const watchdog::Watch watch;
    std::string problem;
    const std::string failure = reason_of_failure([&] {
        try {
            bvhbench::check_clocks(programs_, queue());
        } catch (const BadClock& error) {
            problem = clock_sentence(error);
        }
    });
    if (!failure.empty())
        renew_queue();
    if (!problem.empty())
        throw Unavailable(problem);
}

std::int64_t Session::calibrate()
{
    const watchdog::Watch watch;
    try {
        if (!calibration_)
            calibration_.emplace(programs_, queue());
        const std::int64_t ns = calibration_->take(queue());
        queue().check_times();
        return ns;
    } catch (...) {
        renew_queue();  // else the next sample would find the remaining launches of this one
        throw;
    }
}

void Session::give_head_start()
{
    if (caches_ == Caches::host)
        return;
    if (caches_ == Caches::cold)
        cache_flush_->flush(queue());
    if (!head_start_)
        head_start_.emplace(programs_, queue());
    head_start_->give(queue());
}

std::vector<StageTime> Session::build_once(Builder& builder, const Input& input, Start start,
                                           const Tree** tree)
{
    const watchdog::Watch watch;
    give_head_start();
    const Tree& built = builder.build(input, queue(), start);
    if (tree != nullptr)
        *tree = &built;
    return queue().finish();
}

std::vector<StageTime> Session::refit_once(Builder& builder, const Input& input, const Tree** tree)
{
    const watchdog::Watch watch;
    give_head_start();
    const Tree& refitted = builder.refit(input, queue());
    if (tree != nullptr)
        *tree = &refitted;
    return queue().finish();
}

}  // namespace bvhbench
