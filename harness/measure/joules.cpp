// SPDX-License-Identifier: MIT
#include <algorithm>

#include "device/energy.h"
#include "harness/base/failure.h"
#include "harness/base/test_hooks.h"
#include "harness/measure/engine.h"
#include "process/watchdog.h"

namespace bvhbench {

/// Runs a cell alone in a plain loop, from one step of the device's counter of joules to another; notes joules and watts, or why not.
void Engine::count_joules(Measurement& measurement, Cell& cell)
{
    constexpr double between_looks_s = 0.005;  // looking takes time as well
    const Turns::Turn turn(session_.turns());
    const watchdog::CellScope scope(measurement.number);
    std::function<double()> joules;
    std::string why = reason_of_failure([&] {
        const auto on_host = [](const StageTime& stage) { return stage.launches == 0; };
        if (!session_.device().is_cpu() && std::ranges::any_of(cell.samples.back().stages, on_host))
            throw Unavailable("a stage is on the host, and the device tells of itself");
        joules = energy_counter(session_.device(), powercap());
    });
    if (!why.empty()) {
        cell.left_out["energy_joules"] = std::move(why);
        return;
    }
    double taken = 0, seconds = 0;
    int runs = 0;
    const auto run_for = [&](double least_s) {
        const auto start = std::chrono::steady_clock::now();
        for (; seconds_since(start) < least_s; ++runs)
            measurement.once();
    };
    const auto run_to_a_step = [&] {
        const double before = joules();
        const auto start = std::chrono::steady_clock::now();
        while (joules() == before && seconds_since(start) < 2)
            run_for(between_looks_s);
    };
    session_.set_caches(Caches::host);  // no work before a run
    std::string failure = reason_of_failure([&] {
        run_to_a_step();
        runs = 0;
        const double before = joules();
        const auto start = std::chrono::steady_clock::now();
        run_for(plan_.rules.energy_s);
        run_to_a_step();
        taken = joules() - before;
        seconds = seconds_since(start);
    });
    session_.set_caches(Caches::hot);
    if (!failure.empty())
        return refuse(measurement.cell, Cell::Status::failed, std::move(failure));
    if (taken == 0) {
        cell.left_out["energy_joules"] = "the device's counter of joules stands still";
        return;
    }
    cell.counters["energy_joules"] = taken / runs;
    cell.counters["energy_watts"] = taken / seconds;
}

}  // namespace bvhbench
