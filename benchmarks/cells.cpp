// SPDX-License-Identifier: MIT
#include "benchmarks/cells.h"

#include <algorithm>

#include "harness/base/build_info.h"
#include "harness/base/failure.h"
#include "harness/base/terminal.h"
#include "harness/base/test_hooks.h"
#include "process/watchdog.h"

namespace bvhbench {

PausedScene::PausedScene(Session& session, const std::function<void()>& measure) : session_(session)
{
    session.other_sampler.sample = [this](std::span<Measurement> prepared) {
        if (leaves_)
            return;
        static_cast<void>(Progress(0));  // clears the line, so that results begin one
        cells = prepared;
        prepared_.release();
        sampled_.acquire();
    };
    thread_ = std::thread([this, measure] {
        failure = reason_of_failure(measure);
        cells = {};
        prepared_.release();
    });
    prepared_.acquire();
}

PausedScene::~PausedScene()
{
    leaves_ = true;
    sampled_.release();
    thread_.join();
    session_.other_sampler.sample = {};
}

void PausedScene::resume()
{
    sampled_.release();
    prepared_.acquire();
}

namespace {

/// Returns why a cell may have no times; empty if it may.
std::string fault_of(const Cell& cell)
{
    if (cell.status != Cell::Status::measured)
        return cell.reason;
    return cell.check.verdict == Check::Verdict::differs ? wrong + cell.check.detail : "";
}

}  // namespace

Cells::Cells(const CommonOptions& common, Plan& plan)
    : session_(common)
    , plan_(plan)
    , results_({}, false, measured_facts(session_, {}))
    , run_(session_, results_, {})
{
    watchdog::resume_after_crash({});  // after a crash another process could not continue
    session_.other_sampler.is_wanted = [this](const Cell& cell) {
        return std::ranges::any_of(plan_.cells, [&](const PlannedCell& planned) {
            return planned.scene == scene_ && planned.is_wanted && planned.is(cell);
        });
    };
    benchmark::AddCustomContext("device", session_.device().name());
    benchmark::AddCustomContext("platform", session_.device().platform());
    benchmark::AddCustomContext("bvhbench_version", build_info.version);
    benchmark::AddCustomContext("bvhbench_commit", build_info.commit);
    for (const auto& [name, value] : test_hooks())
        benchmark::AddCustomContext(name, value);
}

/// Returns the prepared cell if the loaded scene has it or comes to it; nullptr if not.
Measurement* Cells::find(const PlannedCell& planned)
{
    for (; planned.scene == scene_ && paused_ && !paused_->cells.empty(); paused_->resume())
        for (Measurement& measurement : paused_->cells)
            if (planned.is_wanted && planned.is(measurement.cell))
                return &measurement;
    return nullptr;
}

std::string Cells::run(benchmark::State& state, PlannedCell& planned, const std::string& stage)
{
    std::string& failure = planned.failure;
    if (!failure.empty())
        return failure;
    Measurement* measurement = find(planned);
    if (measurement == nullptr) {
        planned.is_wanted = true;
        scene_ = planned.scene;
        paused_.reset();
        paused_ = std::make_unique<PausedScene>(session_,
                                                [this] { run_.experiment(plan_.scenes[scene_]); });
        measurement = find(planned);
    }
    if (measurement != nullptr)
        failure = fault_of(measurement->cell);
    else
        failure = paused_->failure.empty() ? "its scene has no such cell" : paused_->failure;
    if (failure.empty())
        failure = sampled(state, *measurement, stage);
    return failure;
}

std::string Cells::sampled(benchmark::State& state, Measurement& measurement,
                           const std::string& stage)
{
    Cell& cell = measurement.cell;
    std::string failure = reason_of_failure([&] {
        session_.set_caches(plan_.scenes[scene_].sampling.caches.front());
        for (; cell.warm_up > 0; --cell.warm_up)
            measurement.once();
    });
    if (failure.empty())
        failure = take_iterations(state, stage, measurement.once);
    session_.set_caches(Caches::hot);
    if (!failure.empty()) {
        session_.renew_queue();  // launches of the failed sample may be left in it
        return failure;
    }
    failure = reason_of_failure(measurement.judge_again);
    for (const auto& [name, value] : cell.counters)
        state.counters[name] = value;
    state.SetItemsProcessed(state.iterations() * cell.scene.triangles);
    state.SetLabel(std::string(verdict_name(cell.check.verdict)));
    return failure.empty() ? fault_of(cell) : failure;
}

}  // namespace bvhbench
