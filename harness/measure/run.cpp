// SPDX-License-Identifier: MIT
#include "harness/measure/run.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

#include "builders/device_tree.h"
#include "device/yardsticks.h"
#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/base/failure.h"
#include "harness/base/test_hooks.h"
#include "harness/judge/check.h"
#include "harness/judge/metrics.h"
#include "harness/measure/cluster.h"
#include "harness/measure/collide.h"
#include "harness/measure/contest.h"
#include "harness/measure/engine.h"
#include "harness/measure/frames.h"
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

/// A builder, its last tree and the stages of its first build; of a refit they are empty.
struct Built {
    Builder* builder = nullptr;
    const Tree* tree = nullptr;
    std::vector<StageTime> first = {};
};

/// Builds or refits the cell's tree for the first time, checks it and writes its quality and size to the cell. `oracle` is that
/// of the frame that the tree is built over.
void prepare(Session& session, const Experiment& experiment, const Frames& frames, Oracle& oracle,
             const NodeCosts& costs, Cell& cell, Built& built)
{
    const bool refits = cell.operation == Operation::refit;
    const Input& first = refits ? frames.before() : frames.now();
    const std::size_t triangles = first.triangle_count();
    require_host_memory("checking the tree", check_bytes(triangles));
    // The reference builds while the builder compiles and builds for the first time.
    if (const auto reference = find_builder(cell.builder.name).oracle; !reference.empty())
        oracle.begin(reference, cell.builder.order, cell.builder.boxes);
    Builder& builder = session.builder(cell.builder, cell.operation);
    built.builder = &builder;
    if (refits && !builder.can_refit())
        throw BadUsage(std::string(builder.card().name) + " cannot refit");
    if (builder.card().runs == BuilderCard::Runs::on_host)
        require_host_memory("the tree", builder.footprint(triangles).total());
    const Device& device = session.device();
    *device.most_taken = 0;
    builder.reserve(triangles);
    cell.first.run_ns = host_ns([&] {
        built.first = session.build_once(builder, first, Start::from_triangles, &built.tree);
    });
    if (refits)
        built.first.clear();  // they are no stages of a refit
    HostTree tree = built.tree->to_host_tree();
    cell.check = check_tree(tree, first, cell.builder, oracle);
    if (refits) {
        session.refit_once(builder, first, &built.tree);  // the same points: nothing may change
        cell.check = check_again(*built.tree, first, std::move(cell.check));
        session.refit_once(builder, frames.now(), &built.tree);
        const HostTree before = std::exchange(tree, built.tree->to_host_tree());
        cell.check = check_refit(tree, before, frames.now(), std::move(cell.check));
    } else if (experiment.start == Start::from_sorted_leaves) {
        session.build_once(builder, first, experiment.start, &built.tree);
        cell.check = check_again(*built.tree, first, std::move(cell.check));
    }
    count_quality(cell, tree, costs);
    if (experiment.quality)
        count_end_point_overlap(cell, tree, frames.now().points, frames.now().faces, costs);
    else
        cell.left_out.try_emplace("epo", "not asked for: --epo");
    const Footprint footprint = builder.reserved();
    cell.counters["nodes_count"] = static_cast<double>(built.tree->node_count());
    cell.counters["tree_bytes"] = static_cast<double>(footprint.tree_bytes);
    cell.counters["scratch_bytes"] = static_cast<double>(footprint.scratch_bytes);
    if (dynamic_cast<const DeviceTree*>(built.tree) != nullptr) {
        const std::size_t others = *device.taken - footprint.total();
        cell.counters["device_peak_bytes"] =
            static_cast<double>(std::max(*device.most_taken, *device.taken) - others);
    } else {
        cell.left_out["device_peak_bytes"] =
            find_builder(cell.builder.name).outside != nullptr
                ? "what a builder from outside takes of the device is not seen"
                : "the builder takes no memory of the device";
    }
}

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
        if (const auto cost = measure_launch_cost(session.programs(), session.queue()); cost.ns > 0)
            facts["launch_cost_ns"] = cost.ns;
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
    const std::string title = experiment.name + ": " + planned.name;
    const std::string name = "scene " + std::to_string(planned.number);
    progress.step(title);
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
    const std::string title = task.experiment + ": " + task.scene;
    task.number = std::to_string(number_);
    task.pipelines = chosen(task, filter);
    if (experiment.quality)
        task.quality = costs_;
    task.note = [&](const std::string& what, double share) {
        progress.note(title + ", " + what, share);
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

void Run::scene(const Experiment& experiment, const std::string& name,
                std::span<const BuilderChoice> builders, Progress& progress)
{
    const std::string number = std::to_string(number_) + '/';
    if (results_.pass(builders.size() * experiment.operations.size() *
                      experiment.sampling.caches.size()))
        return;
    Frames frames;
    Cell empty;
    empty.experiment = experiment.name;
    empty.scene.name = name;
    std::string no_scene;
    const auto load = [&] {
        frames.load(experiment, name, session_.scenes());
        empty.scene = frames.facts();
        frames.upload(session_);
    };
    if (experiment.needs_scene)
        load();
    else
        no_scene = reason_of_failure(load);

    Oracle oracle(session_, frames.now()), oracle_before(session_, frames.before());
    const Note note = [&](const std::string& what, double share) {
        progress.note(experiment.name + ": " + name + ", " + what, share);
    };
    Engine engine(session_, {experiment.samples, experiment.warm_up, experiment.sampling}, order_,
                  note);
    const std::size_t count = builders.size() * experiment.operations.size();
    Contest contest(experiment.sampling.race);
    std::vector<Measurement> measurements(count);
    std::vector<Built> built(count);
    for (std::size_t k = 0; k < count; ++k) {
        Measurement& measurement = measurements[k];
        measurement = {.cell = empty, .number = number + std::to_string(k)};
        measurement.cell.builder = builders[k / experiment.operations.size()];
        measurement.cell.operation = experiment.operations[k % experiment.operations.size()];
        const BuilderEntry& entry = find_builder(measurement.cell.builder.name);
        std::string why(entry.absent);
        const auto status = entry.is_broken ? Cell::Status::failed : Cell::Status::skipped;
        if (why.empty() && measurement.cell.operation == Operation::build)
            why = contest.why_not(measurement.cell);
        if (!no_scene.empty() || !why.empty()) {
            engine.refuse(measurement, no_scene.empty() ? status : Cell::Status::skipped,
                          no_scene.empty() ? why : no_scene);
            continue;
        }
        note(measurement.cell.builder.name + ", cell " + std::to_string(k + 1) + " of " +
                 std::to_string(count),
             0);
        engine.prepare(measurement, [&] {
            Oracle& own = measurement.cell.operation == Operation::refit ? oracle_before : oracle;
            prepare(session_, experiment, frames, own, costs_, measurement.cell, built[k]);
        });
        measurement.once = [&, k] {
            return measurement.cell.operation == Operation::refit
                       ? session_.refit_once(*built[k].builder, frames.now(), &built[k].tree)
                       : session_.build_once(*built[k].builder, frames.now(), experiment.start,
                                             &built[k].tree);
        };
        measurement.upload = [&] { frames.upload_points(session_); };
        if (entry.outside != nullptr)
            measurement.no_copies = no_copies_of_outside;
        measurement.judge_again = [&, k] {
            measurement.cell.check =
                check_again(*built[k].tree, frames.now(), std::move(measurement.cell.check));
        };
        if (experiment.start == Start::from_triangles)
            measurement.stages_before = built[k].first;
        engine.sample_first(measurement, contest);
    }
    oracle.wait();  // builders that failed may have begun references that are still running
    oracle_before.wait();
    for (const Cell& cell : engine.sample(measurements))
        results_.add(cell);
}

}  // namespace bvhbench
