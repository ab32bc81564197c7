// SPDX-License-Identifier: MIT
#include "harness/measure/run.h"

#include <chrono>
#include <cstdio>
#include <utility>

#include "device/yardsticks.h"
#include "harness/base/failure.h"
#include "harness/base/test_hooks.h"
#include "harness/measure/cluster.h"
#include "harness/measure/collide.h"
#include "harness/record/provenance.h"
#include "process/watchdog.h"

namespace bvhbench {
namespace {

/// Guesses the time of the scenes that are left from those before, by their weights.
struct TimeLeft {
    double weight = 0;  ///< of the scenes that are left
    double known_weight = 0, known_seconds = 0;

    void count(double done, double seconds)
    {
        weight -= done;
        if (seconds > 0) {
            known_weight += done;
            known_seconds += seconds;
        }
    }

    /// Returns "; about 3 min left", or nothing.
    std::string text() const
    {
        const double seconds = known_weight > 0 ? weight * known_seconds / known_weight : 0;
        return seconds > 0 ? "; about " + rough(seconds) + " left" : "";
    }
};

}  // namespace

Json measured_facts(Session& session, std::vector<std::string> command, const NodeCosts& costs)
{
    session.check_clocks();
    Json facts = run_facts(session.device(), std::move(command), costs);
    const std::string failure = reason_of_failure([&] {
        const CopyRate rate = measure_copy_rate(session.programs(), session.queue(), most_copied());
        if (rate.bytes_per_s > 0) {
            facts["copy_rate_bytes_per_s"] = rate.bytes_per_s;
            facts["copy_rate_buffer_bytes"] = rate.buffer_bytes;
        }
        put_if(facts, "launch_cost_ns",
               measure_launch_cost(session.programs(), session.queue()).ns);
    });
    if (!failure.empty())
        session.renew_queue();  // a device without room for the copy can still build small trees
    return facts;
}

void Run::experiment(const Experiment& experiment)
{
    RunPlan plan{.name = experiment.name, .parts = {experiment}};
    scenes(plan, planned_scenes(plan, {}, {}, ""), {}, [] {});
}

bool Run::scenes(const RunPlan& plan, std::span<const PlannedScene> scenes,
                 const CellFilter& filter, const std::function<void()>& begin)
{
    using Clock = std::chrono::steady_clock;
    Progress progress(scenes.size());
    TimeLeft left;
    for (const PlannedScene& planned : scenes)
        left.weight += planned.weight;
    bool has_begun = false;
    for (std::size_t k = 0; k < scenes.size(); ++k) {
        const PlannedScene& planned = scenes[k];
        if (!planned.key.empty()) {
            if (const auto seconds = results_.take_part(planned.key)) {
                left.count(planned.weight, *seconds);
                progress.pass();
                continue;
            }
            if (has_begun && plan.has_parts && results_.has_journal() &&
                watchdog::can_begin_another()) {
                watchdog::begin_another();
                results_.leave();
                return false;
            }
        }
        if (!std::exchange(has_begun, true))
            begin();
        if (!planned.key.empty())
            results_.begin_part(planned.key);
        const auto start = Clock::now();
        measure(planned, filter, progress);
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        if (!planned.key.empty())
            results_.end_part(seconds);
        left.count(planned.weight, seconds);
        if (plan.has_parts) {
            progress.clear();
            const std::string& label = planned.experiment->label;
            std::printf("[%zu/%zu] %s: %s, %.1f s%s\n", k + 1, scenes.size(),
                        printable(label.empty() ? planned.name : label).c_str(),
                        printable(results_.outcome_of_part()).c_str(), seconds,
                        left.text().c_str());
            std::fflush(stdout);
        }
    }
    return true;
}

void Run::measure(const PlannedScene& planned, const CellFilter& filter, Progress& progress)
{
    const Experiment& experiment = *planned.experiment;
    const std::string name = "scene " + std::to_string(planned.number);
    progress.step(experiment.name + ": " + planned.name);
    if (const std::string why = watchdog::given_up(name); !why.empty()) {
        results_.take_rest();
        for (Cell& cell : planned_cells(planned, filter)) {
            cell.status = Cell::Status::failed;
            cell.reason = why;
            results_.add(cell);
        }
        return;
    }
    const watchdog::CellScope scope(name);  // for a process that ends outside of a cell
    number_ = planned.number;
    session_.read_doubles(experiment.doubles);
    if (planned.cluster != nullptr)
        cluster(*planned.cluster);
    else if (planned.collides != nullptr)
        collisions(experiment, *planned.collides, filter, progress);
    else
        scene(experiment, planned.name, chosen(experiment, planned.name, filter), progress);
}

void Run::collisions(const Experiment& experiment, CollideTask task, const CellFilter& filter,
                     Progress& progress)
{
    task.number = std::to_string(number_);
    task.pipelines = chosen(task, filter);
    if (experiment.quality)
        task.quality = costs_;
    task.note = [&](const std::string& what, double share) {
        progress.note(task.experiment + ": " + task.scene + ", " + what, share);
    };
    collide_frames(
        session_, task, order_,
        [&](std::vector<Cell>&& cells, const Found&) {
            for (const Cell& cell : cells)
                results_.add(cell);
        },
        [&](std::size_t cells) { return results_.pass(cells); });
}

void Run::cluster(const ClusterTask& task)
{
    if (results_.pass(1))
        return;
    bool cannot_be = false;
    const auto measure = [&] {
        if (task.simulates != 0)
            results_.add(cell_of(simulate_cluster(session_, task)));
        else
            results_.add(cell_by_ranks(task, common_));
    };
    Cell failed = planned_cell(task);
    failed.reason = reason_of_failure(measure, &cannot_be);
    if (failed.reason.empty())
        return;
    session_.renew_queue();
    failed.status = cannot_be ? Cell::Status::skipped : Cell::Status::failed;
    results_.add(failed);
}

}  // namespace bvhbench
