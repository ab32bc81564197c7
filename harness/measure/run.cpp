// SPDX-License-Identifier: MIT
#include "harness/measure/run.h"

#include <algorithm>

#include "device/yardsticks.h"
#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/base/failure.h"
#include "harness/judge/check.h"
#include "harness/judge/metrics.h"
#include "harness/measure/collide.h"
#include "harness/measure/contest.h"
#include "harness/measure/engine.h"
#include "harness/measure/frames.h"
#include "harness/record/provenance.h"
#include "harness/session/watchdog.h"

namespace bvhbench {
namespace {

/// Returns the task's pipelines that match the filter.
std::vector<PipelineChoice> chosen(const CollideTask& task, const CellFilter& filter)
{
    std::vector<PipelineChoice> pipelines = task.pipelines;
    std::erase_if(pipelines, [&](const PipelineChoice& pipeline) {
        return filter && !filter->is_in(task.scene + '/' + pipeline.builder.name + '/' +
                                        pipeline.collider.name);
    });
    return pipelines;
}

std::vector<BuilderChoice> chosen(const Experiment& experiment, const std::string& scene,
                                  const CellFilter& filter)
{
    std::vector<BuilderChoice> builders;
    for (const BuilderChoice& builder : experiment.builders)
        if (!filter || filter->is_in(scene + '/' + builder.name))
            builders.push_back(builder);
    return builders;
}

/// Writes the quality of a tree to the cell. A wrong tree has none.
void count_quality(Cell& cell, const HostTree& tree, const Input& input, const NodeCosts& costs,
                   bool with_epo)
{
    if (cell.check.verdict == Check::Verdict::differs) {
        for (const char* counter : {"sah_cost", "sibling_overlap", "depth_max", "epo"})
            cell.left_out[counter] = "the tree is wrong";
        return;
    }
    Quality quality = quality_of(tree, costs);
    if (with_epo)
        add_end_point_overlap(quality, tree, input.points, input.faces, costs);
    else
        quality.left_out["epo"] = "not asked for: --epo";
    cell.counters.merge(quality.counters);
    cell.left_out = std::move(quality.left_out);
    cell.leaves_by_depth = std::move(quality.leaves_by_depth);
}

}  // namespace

RunFacts measured_facts(Session& session, std::vector<std::string> command, const NodeCosts& costs)
{
    RunFacts facts = run_facts(session.device(), std::move(command));
    facts.costs = costs;
    const std::string failure = reason_of_failure([&] {
        const CopyRate rate = measure_copy_rate(session.programs(), session.queue());
        facts.copy_rate_bytes_per_s = rate.bytes_per_s;
        facts.copy_rate_buffer_bytes = static_cast<std::int64_t>(rate.buffer_bytes);
        facts.launch_cost_ns = measure_launch_cost(session.programs(), session.queue()).ns;
    });
    if (!failure.empty())
        session.renew_queue();  // a device without room for the copy can still build small trees
    return facts;
}

/// A builder, its last tree and the stages of its first build; of a refit they are empty.
struct Run::Built {
    Builder* builder = nullptr;
    const Tree* tree = nullptr;
    std::vector<StageTime> first = {};
};

/// Oracles for the frame that cells are about and for the frame that refits start from.
struct Run::Oracles {
    Oracle now, before;
};

Run::Run(Session& session, Output output, std::vector<std::string> command, const NodeCosts& costs)
    : session_(session)
    , costs_(costs)
    , results_(std::move(output), measured_facts(session, std::move(command), costs),
               watchdog::run_id())
    , order_(results_.next_order())
{
    watchdog::go_on_with(results_.run_id());
}

void Run::finish()
{
    if (const Turns* turns = session_.turns())
        results_.took_turns({turns->others().begin(), turns->others().end()});
    results_.finish(session_.programs().compile_ns());
}

std::vector<std::string> files_of(const std::vector<std::string>& scenes,
                                  const SceneLibrary& library)
{
    std::vector<std::string> files;
    for (const std::string& scene : scenes)
        std::ranges::move(scene_files(scene, library), std::back_inserter(files));
    return files;
}

CellFilter cell_filter(const std::string& text)
{
    return text.empty() ? CellFilter() : Pattern(text, "--filter");
}

bool has_cells(const Experiment& experiment, const CellFilter& filter)
{
    return std::any_of(experiment.scenes.begin(), experiment.scenes.end(),
                       [&](const std::string& scene) {
                           return !chosen(experiment, scene, filter).empty();
                       }) ||
           std::any_of(experiment.collisions.begin(), experiment.collisions.end(),
                       [&](const CollideTask& task) { return !chosen(task, filter).empty(); });
}

void Run::experiment(const Experiment& experiment, const CellFilter& filter)
{
    session_.read_doubles(experiment.doubles);
    Progress progress(experiment.scenes.size() + experiment.collisions.size());
    for (const CollideTask& task : experiment.collisions)
        collisions(task, filter, progress);
    for (const std::string& name : experiment.scenes) {
        const std::vector<BuilderChoice> builders = chosen(experiment, name, filter);
        progress.step(experiment.name + ": " + name);
        if (!builders.empty())
            scene(experiment, name, builders, progress);
    }
}

void Run::collisions(CollideTask task, const CellFilter& filter, Progress& progress)
{
    const std::string title = task.experiment + ": " + task.scene;
    progress.step(title);
    task.number = std::to_string(scenes_++);
    task.pipelines = chosen(task, filter);
    task.note = [&](const std::string& what) { progress.note(title + ", " + what); };
    if (task.pipelines.empty())
        return;
    collide_frames(
        session_, task, order_,
        [&](std::vector<Cell>&& cells, const Found&) {
            task.note("frame " + std::to_string(cells.front().scene.frame));
            for (const Cell& cell : cells)
                results_.add(cell);
        },
        [&](std::size_t cells) { return results_.pass(cells); });
}

void Run::scene(const Experiment& experiment, const std::string& name,
                std::span<const BuilderChoice> builders, Progress& progress)
{
    const std::string number = std::to_string(scenes_++) + '/';
    if (results_.pass(builders.size() * experiment.operations.size()))
        return;
    Frames frames;
    Cell empty;
    empty.experiment = experiment.name;
    empty.scene.name = name;
    empty.warm_up = experiment.warm_up;
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

    Oracles oracles{{session_, frames.now()}, {session_, frames.before()}};
    Engine engine(session_, {experiment.samples, experiment.warm_up, experiment.sampling}, order_);
    const std::size_t count = builders.size() * experiment.operations.size();
    Contest contest(experiment.sampling.race);
    std::vector<Subject> subjects(count);
    std::vector<Built> built(count);
    for (std::size_t k = 0; k < count; ++k) {
        Subject& subject = subjects[k];
        subject = {.cell = empty, .number = number + std::to_string(k)};
        subject.cell.builder = builders[k / experiment.operations.size()];
        subject.cell.operation = experiment.operations[k % experiment.operations.size()];
        std::string why(find_builder(subject.cell.builder.name).absent);
        if (why.empty() && subject.cell.operation == Operation::build)
            why = contest.why_not(subject.cell);
        if (!no_scene.empty() || !why.empty()) {
            engine.refuse(subject, Cell::Status::skipped, no_scene.empty() ? why : no_scene);
            continue;
        }
        engine.settle(subject,
                      [&] { settle(experiment, frames, subject.cell, built[k], oracles); });
        subject.once = [&, k] {
            return subject.cell.operation == Operation::refit
                       ? session_.refit_once(*built[k].builder, frames.now(), &built[k].tree)
                       : session_.build_once(*built[k].builder, frames.now(), experiment.start,
                                             &built[k].tree);
        };
        subject.judge_again = [&, k] {
            subject.cell.check = check_again(*built[k].tree, std::move(subject.cell.check));
        };
        if (experiment.start == Start::from_triangles)
            subject.settled = built[k].first;
        engine.look(subject, contest);
    }
    oracles.now.wait();  // builders that failed may have begun references that are still running
    oracles.before.wait();
    progress.note(experiment.name + ": " + name + ", sampling");
    engine.sample(subjects);
    for (const Subject& subject : subjects)
        results_.add(subject.cell);
}

void Run::settle(const Experiment& experiment, const Frames& frames, Cell& cell, Built& built,
                 Oracles& oracles)
{
    const bool refits = cell.operation == Operation::refit;
    const std::size_t triangles = frames.now().triangle_count();
    require_host_memory("checking the tree", check_bytes(triangles));
    Oracle& oracle = refits ? oracles.before : oracles.now;
    // The reference builds while the builder compiles and builds for the first time.
    if (const auto reference = find_builder(cell.builder.name).oracle; !reference.empty())
        oracle.begin(reference, cell.builder.order, cell.builder.boxes);
    Builder& builder = session_.builder(cell.builder, cell.operation);
    built.builder = &builder;
    if (refits && !builder.can_refit())
        throw BadUsage(std::string(builder.card().name) + " cannot refit");
    if (builder.card().runs == BuilderCard::Runs::on_host)
        require_host_memory("the tree", builder.footprint(triangles).total());
    builder.reserve(triangles);
    if (refits)
        judge_refit(experiment, frames, cell, built, oracle);
    else
        judge_build(experiment, frames, cell, built, oracle);
    const Footprint footprint = builder.reserved();
    cell.counters["nodes_count"] = static_cast<double>(built.tree->node_count());
    cell.counters["tree_bytes"] = static_cast<double>(footprint.tree_bytes);
    cell.counters["scratch_bytes"] = static_cast<double>(footprint.scratch_bytes);
}

void Run::judge_build(const Experiment& experiment, const Frames& frames, Cell& cell, Built& built,
                      Oracle& oracle)
{
    cell.first.run_ns = host_ns([&] {
        built.first =
            session_.build_once(*built.builder, frames.now(), Start::from_triangles, &built.tree);
    });
    const HostTree tree = built.tree->spelled_out();
    cell.check = check_tree(tree, frames.now(), cell.builder, oracle);
    count_quality(cell, tree, frames.now(), costs_, experiment.quality);
    if (experiment.start == Start::from_sorted_leaves) {
        session_.build_once(*built.builder, frames.now(), experiment.start, &built.tree);
        cell.check = check_again(*built.tree, std::move(cell.check));
    }
}

/// Checks the built tree, a refit to the same points, which must not change it, and a refit to the moved points.
void Run::judge_refit(const Experiment& experiment, const Frames& frames, Cell& cell, Built& built,
                      Oracle& oracle)
{
    cell.first.run_ns = host_ns([&] {
        session_.build_once(*built.builder, frames.before(), Start::from_triangles, &built.tree);
    });
    const HostTree before = built.tree->spelled_out();
    cell.check = check_tree(before, frames.before(), cell.builder, oracle);
    session_.refit_once(*built.builder, frames.before(), &built.tree);
    cell.check = check_again(*built.tree, std::move(cell.check));
    session_.refit_once(*built.builder, frames.now(), &built.tree);
    const HostTree tree = built.tree->spelled_out();
    cell.check = check_refit(tree, before, frames.now(), std::move(cell.check));
    count_quality(cell, tree, frames.now(), costs_, experiment.quality);
}

}  // namespace bvhbench
