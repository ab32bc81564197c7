// SPDX-License-Identifier: MIT
#include "benchmarks/cells.h"

#include "harness/base/failure.h"
#include "harness/measure/collide.h"
#include "harness/session/watchdog.h"

namespace bvhbench {

Cells::Cells(Session& session, const Plan& plan, std::set<std::string> wanted)
    : session_(session), plan_(plan), wanted_(std::move(wanted)), run_(session, Output(), {}, {})
{
    watchdog::go_on_with({});  // after a crash another process could not continue
}

/// Begins to measure the cell's scene, with all wanted cells.
void Cells::load(const PlannedCell& planned)
{
    held_.reset();
    ended_.clear();
    warm_.clear();
    scene_ = planned.scene;
    wanted_.insert(planned.name);
    held_ = std::make_unique<HeldScene>([this] {
        const Experiment one = narrowed(plan_, scene_, wanted_);
        session_.read_doubles(one.doubles);
        if (one.collisions.empty())
            return run_.experiment(one);
        const auto keep = [this](std::vector<Cell>&& cells, const Found&) { ended_ = cells; };
        collide_frames(session_, one.collisions.front(), order_, keep);
    });
}

/// Returns the cell, settled, if the scene held has it or comes to it; nullptr if not.
Subject* Cells::find(const PlannedCell& planned)
{
    for (; planned.scene == scene_ && held_ && !held_->cells().empty(); held_->go_on())
        for (Subject& subject : held_->cells())
            if (planned.is(subject.cell))
                return &subject;
    return nullptr;
}

/// Returns why the scene has ended without settling the cell.
std::string Cells::reason_without(const PlannedCell& planned) const
{
    for (const Cell& cell : ended_)
        if (planned.is(cell) && !cell.reason.empty())
            return cell.reason;
    return held_->failure().empty() ? "its scene has no such cell" : held_->failure();
}

namespace {

/// Returns why a cell may have no times; empty if it may.
std::string fault_of(const Cell& cell)
{
    if (cell.status != Cell::Status::measured)
        return cell.reason;
    const bool differs = cell.check.verdict == Check::Verdict::differs;
    return differs ? "the result is wrong: " + cell.check.detail : "";
}

}  // namespace

void Cells::run(benchmark::State& state, const PlannedCell& planned, const std::string& stage,
                Outcome& outcome)
{
    std::string& failure = failed_[planned.name];
    Subject* subject = nullptr;
    if (failure.empty()) {
        subject = find(planned);
        if (subject == nullptr) {
            load(planned);
            subject = find(planned);
        }
        failure = subject != nullptr ? fault_of(subject->cell) : reason_without(planned);
    }
    if (failure.empty() && warm_.insert(planned.name).second)
        failure = reason_of_failure([&] {
            session_.empty_caches(plan_.scenes[scene_].sampling.cold);
            for (int k = 0; k < subject->cell.warm_up; ++k)
                subject->once();
        });
    if (!failure.empty())
        fail(state, failure);
    else
        failure = sampled(state, *subject, stage);
    outcome.has_measured |= failure.empty();
    if (!failure.empty())
        outcome.reason = failure;
    if (subject != nullptr)
        outcome.differs |= subject->cell.check.verdict == Check::Verdict::differs;
}

/// Returns why the cell has no times to show; empty if it has.
std::string Cells::sampled(benchmark::State& state, Subject& subject, const std::string& stage)
{
    const Cell& cell = subject.cell;
    session_.empty_caches(plan_.scenes[scene_].sampling.cold);
    std::string failure =
        take_iterations(state, cell.collider.name.empty() ? cell.builder.name : cell.collider.name,
                        stage, subject.once);
    session_.empty_caches(false);
    if (!failure.empty()) {
        session_.renew_queue();  // launches of the failed sample may be left in it
        return failure;
    }
    failure = reason_of_failure(subject.judge_again);
    if (failure.empty())
        failure = fault_of(cell);
    if (!failure.empty()) {
        state.SkipWithError(failure.c_str());
        return failure;
    }
    for (const auto& [name, value] : cell.counters)
        state.counters[name] = value;
    state.SetItemsProcessed(state.iterations() * cell.scene.triangles);
    state.SetLabel(std::string(verdict_name(cell.check.verdict)));
    return {};
}

}  // namespace bvhbench
