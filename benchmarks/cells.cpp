// SPDX-License-Identifier: MIT
#include "benchmarks/cells.h"

#include <algorithm>

#include "harness/base/build_info.h"
#include "harness/base/failure.h"
#include "harness/base/terminal.h"
#include "harness/base/test_hooks.h"
#include "harness/session/watchdog.h"

namespace bvhbench {

HeldScene::HeldScene(Session& session, const std::function<void()>& measure) : session_(session)
{
    session.other_sampler.sample = [this](std::span<Subject> settled) {
        if (leaves_)
            return;
        static_cast<void>(Progress(0));  // clears the line, so that results begin one
        cells = settled;
        settled_.release();
        sampled_.acquire();
    };
    thread_ = std::thread([this, measure] {
        failure = reason_of_failure(measure);
        cells = {};
        settled_.release();
    });
    settled_.acquire();
}

HeldScene::~HeldScene()
{
    leaves_ = true;
    sampled_.release();
    thread_.join();
    session_.other_sampler.sample = {};
}

void HeldScene::go_on()
{
    sampled_.release();
    settled_.acquire();
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
    watchdog::go_on_with({});  // after a crash another process could not continue
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
Subject* Cells::find(const PlannedCell& planned)
{
    for (; planned.scene == scene_ && held_ && !held_->cells.empty(); held_->go_on())
        for (Subject& subject : held_->cells)
            if (planned.is_wanted && planned.is(subject.cell))
                return &subject;
    return nullptr;
}

std::string Cells::run(benchmark::State& state, PlannedCell& planned, const std::string& stage)
{
    std::string& failure = planned.failure;
    if (!failure.empty())
        return failure;
    Subject* subject = find(planned);
    if (subject == nullptr) {
        planned.is_wanted = true;
        scene_ = planned.scene;
        held_.reset();
        held_ = std::make_unique<HeldScene>(session_,
                                            [this] { run_.experiment(plan_.scenes[scene_]); });
        subject = find(planned);
    }
    if (subject != nullptr)
        failure = fault_of(subject->cell);
    else
        failure = held_->failure.empty() ? "its scene has no such cell" : held_->failure;
    if (failure.empty())
        failure = sampled(state, *subject, stage);
    return failure;
}

std::string Cells::sampled(benchmark::State& state, Subject& subject, const std::string& stage)
{
    Cell& cell = subject.cell;
    std::string failure = reason_of_failure([&] {
        session_.set_caches(plan_.scenes[scene_].sampling.caches.front());
        for (; cell.warm_up > 0; --cell.warm_up)
            subject.once();
    });
    if (failure.empty())
        failure = take_iterations(state, stage, subject.once);
    session_.set_caches(Caches::hot);
    if (!failure.empty()) {
        session_.renew_queue();  // launches of the failed sample may be left in it
        return failure;
    }
    failure = reason_of_failure(subject.judge_again);
    for (const auto& [name, value] : cell.counters)
        state.counters[name] = value;
    state.SetItemsProcessed(state.iterations() * cell.scene.triangles);
    state.SetLabel(std::string(verdict_name(cell.check.verdict)));
    return failure.empty() ? fault_of(cell) : failure;
}

}  // namespace bvhbench
