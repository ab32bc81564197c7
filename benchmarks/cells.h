// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <semaphore>
#include <span>
#include <string>
#include <thread>

#include "benchmarks/iterations.h"
#include "benchmarks/plan.h"
#include "harness/measure/engine.h"
#include "harness/measure/run.h"

namespace bvhbench {

/// A call of the harness that waits where it would sample. The harness loads a scene, prepares its cells and samples them in one
/// call, but Google Benchmark calls a function for each repetition of a cell, in any order. Therefore the call has a thread of its
/// own, which waits while the cells are sampled outside: only one of the two threads works at any time. A session has one at a time.
class PausedScene {
public:
    std::span<Measurement>
        cells;            ///< prepared together, valid until resume(); empty if the call has ended
    std::string failure;  ///< why the call threw; empty if it did not

    /// Begins the call and waits until it has prepared cells or ended.
    PausedScene(Session& session, const std::function<void()>& measure);
    ~PausedScene();  ///< lets the call end
    PausedScene(const PausedScene&) = delete;
    PausedScene& operator=(const PausedScene&) = delete;

    /// Waits until the call has prepared its next cells or ended.
    void resume();

private:
    Session& session_;
    bool leaves_ = false;  ///< whether the call is to end without further waiting
    std::binary_semaphore prepared_{0}, sampled_{0};
    std::thread thread_;
};

/// The cells of a plan on one device. A scene is loaded, and those of its cells that are wanted are prepared and judged, when the
/// first of them runs. The scene is released when a cell of another scene runs.
class Cells {
public:
    /// Opens the device and names it in the output. `plan` must outlive this object.
    Cells(const CommonOptions& common, Plan& plan);

    /// Runs the iterations of `state` by take_iterations, judges the cell again, and gives `state` its counters and verdict.
    /// Returns why it has no times: its result is wrong, or it cannot be measured.
    std::string run(benchmark::State& state, PlannedCell& planned, const std::string& stage);

private:
    Measurement* find(const PlannedCell& planned);
    std::string sampled(benchmark::State& state, Measurement& measurement,
                        const std::string& stage);

    Session session_;
    Plan& plan_;
    ResultFile results_;
    Run run_;
    std::size_t scene_ = 0;  ///< number of the loaded scene
    std::unique_ptr<PausedScene> paused_;
};

}  // namespace bvhbench
