// SPDX-License-Identifier: MIT
#include "harness/run.h"

#include <algorithm>

#include "device/copy_rate.h"
#include "device/launch_cost.h"
#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/check.h"
#include "harness/failure.h"
#include "harness/frames.h"
#include "harness/metrics.h"
#include "harness/provenance.h"
#include "harness/sampler.h"
#include "harness/session_samples.h"

namespace bvhbench {
namespace {

Cell unmeasured(Cell cell, Cell::Status status, std::string reason)
{
    cell.status = status;
    cell.reason = std::move(reason);
    cell.samples.clear();
    return cell;
}

/// Of the task, those that the filter leaves.
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

void put(Quality&& quality, Cell& cell)
{
    cell.counters.merge(quality.counters);
    cell.left_out = std::move(quality.left_out);
    cell.leaves_by_depth = std::move(quality.leaves_by_depth);
}

/// How good a tree is. One that is wrong has no quality.
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
    put(std::move(quality), cell);
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

/// A cell on its way to being measured; without a builder it is finished already.
struct Run::Prepared {
    Cell cell;
    std::string number = {};  ///< which of the run's cells it is
    Builder* builder = nullptr;
    const Tree* tree = nullptr;
};

/// For the frame that cells are about, and for the one that refits start from.
struct Run::Oracles {
    Oracle now, before;
};

Run::Run(Session& session, Output output, std::vector<std::string> command, const NodeCosts& costs)
    : session_(session)
    , results_(std::move(output), measured_facts(session, std::move(command), costs),
               session.watchdog().run_id())
    , order_(results_.next_order())
{
    session.watchdog().keep_by(document().run.id, [this] { results_.keep(); });
}

void Run::finish()
{
    if (const Turns* turns = session_.turns())
        results_.took_turns({turns->others().begin(), turns->others().end()});
    results_.finish(session_.programs().compile_ns());
}

CellFilter cell_filter(const std::string& text)
{
    if (text.empty())
        return std::nullopt;
    return Pattern(text, "--filter");
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

int exit_code_of(const Document& document)
{
    const std::vector<Cell>& cells = document.cells;
    const auto is_measured = [](const Cell& cell) { return cell.status == Cell::Status::measured; };
    if (!cells.empty() && std::none_of(cells.begin(), cells.end(), is_measured))
        throw NothingMeasured(
            "nothing was measured: " + cells.front().reason +
            (cells.size() > 1 ? " (the first of " + std::to_string(cells.size()) + " cells)" : ""));
    return std::any_of(cells.begin(), cells.end(),
                       [&](const Cell& cell) {
                           return is_measured(cell) &&
                                  cell.check.verdict == Check::Verdict::differs;
                       })
               ? 1
               : 0;
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
    progress.step(task.experiment + ": " + task.scene);
    task.number = std::to_string(scenes_++);
    task.pipelines = chosen(task, filter);
    task.note = [&](const std::string& what) {
        progress.note(task.experiment + ": " + task.scene + ", " + what);
    };
    if (task.pipelines.empty())
        return;
    collide_frames(
        session_, task, order_,
        [&](std::vector<Cell>&& cells, const Found&) {
            progress.note(task.experiment + ": " + task.scene + ", frame " +
                          std::to_string(cells.front().scene.frame));
            for (Cell& cell : cells)
                results_.add(std::move(cell));
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
    std::vector<Prepared> cells;
    for (const BuilderChoice& builder : builders)
        for (const Operation operation : experiment.operations) {
            empty.builder = builder;
            empty.operation = operation;
            if (!no_scene.empty())
                cells.push_back({unmeasured(empty, Cell::Status::skipped, no_scene)});
            else
                cells.push_back(prepare(experiment, frames, empty,
                                        number + std::to_string(cells.size()), oracles));
        }
    oracles.now.wait();  // of builders that failed meanwhile, too
    oracles.before.wait();
    progress.note(experiment.name + ": " + name + ", sampling");
    sample(experiment, frames, cells);
    for (Prepared& cell : cells)
        results_.add(std::move(cell.cell));
}

Run::Prepared Run::prepare(const Experiment& experiment, const Frames& frames, Cell cell,
                           std::string number, Oracles& oracles)
{
    std::string why_not(find_builder(cell.builder.name).absent);
    if (!why_not.empty())
        return {unmeasured(std::move(cell), Cell::Status::skipped, std::move(why_not))};

    if (std::string why = session_.watchdog().given_up(number); !why.empty())
        return {unmeasured(std::move(cell), Cell::Status::failed, std::move(why))};

    Prepared prepared{std::move(cell), std::move(number)};
    const Watchdog::Hand hand(session_.watchdog(), prepared.number);
    const std::int64_t compiled_ns = session_.programs().compile_ns();
    bool cannot_be = false;
    const std::string failure = reason_of_failure(cannot_be, [&] {
        const bool refits = prepared.cell.operation == Operation::refit;
        const std::size_t triangles = frames.now().triangle_count();
        require_host_memory("checking the tree", check_bytes(triangles));
        Oracle& oracle = refits ? oracles.before : oracles.now;
        // While the builder is compiled and builds for the first time.
        if (const auto reference = find_builder(prepared.cell.builder.name).oracle;
            !reference.empty())
            oracle.begin(reference, prepared.cell.builder.order, prepared.cell.builder.boxes);
        Builder& builder = session_.builder(prepared.cell.builder, prepared.cell.operation);
        if (refits && !builder.can_refit())
            throw BadUsage(std::string(builder.card().name) + " cannot refit");
        if (builder.card().runs == BuilderCard::Runs::on_host)
            require_host_memory("the tree", builder.footprint(triangles).total());
        builder.reserve(triangles);
        if (refits)
            judge_refit(experiment, frames, builder, prepared, oracle);
        else
            judge_build(experiment, frames, builder, prepared, oracle);
        const Footprint footprint = builder.reserved();
        auto& counters = prepared.cell.counters;
        counters["nodes_count"] = static_cast<double>(prepared.tree->node_count());
        counters["tree_bytes"] = static_cast<double>(footprint.tree_bytes);
        counters["scratch_bytes"] = static_cast<double>(footprint.scratch_bytes);
        prepared.builder = &builder;
        prepared.cell.first.compile_ns = session_.programs().compile_ns() - compiled_ns;
    });
    if (!failure.empty()) {
        session_.renew_queue();
        return {unmeasured(std::move(prepared.cell),
                           cannot_be ? Cell::Status::skipped : Cell::Status::failed, failure)};
    }
    return prepared;
}

void Run::judge_build(const Experiment& experiment, const Frames& frames, Builder& builder,
                      Prepared& prepared, Oracle& oracle)
{
    Cell& cell = prepared.cell;
    cell.first.run_ns = host_ns(
        [&] { session_.build_once(builder, frames.now(), Start::from_triangles, &prepared.tree); });
    const HostTree tree = prepared.tree->spelled_out();
    cell.check = check_tree(tree, frames.now(), cell.builder, oracle);
    count_quality(cell, tree, frames.now(), document().run.costs, experiment.quality);
    if (experiment.start == Start::from_sorted_leaves) {
        session_.build_once(builder, frames.now(), experiment.start, &prepared.tree);
        cell.check = check_again(*prepared.tree, std::move(cell.check));
    }
}

/// The tree that stands must be right, stay what it is while nothing moves, and then follow the points.
void Run::judge_refit(const Experiment& experiment, const Frames& frames, Builder& builder,
                      Prepared& prepared, Oracle& oracle)
{
    Cell& cell = prepared.cell;
    cell.first.run_ns = host_ns([&] {
        session_.build_once(builder, frames.before(), Start::from_triangles, &prepared.tree);
    });
    const HostTree built = prepared.tree->spelled_out();
    cell.check = check_tree(built, frames.before(), cell.builder, oracle);
    session_.refit_once(builder, frames.before(), &prepared.tree);
    cell.check = check_again(*prepared.tree, std::move(cell.check));
    session_.refit_once(builder, frames.now(), &prepared.tree);
    const HostTree tree = prepared.tree->spelled_out();
    cell.check = check_refit(tree, built, frames.now(), std::move(cell.check));
    count_quality(cell, tree, frames.now(), document().run.costs, experiment.quality);
}

void Run::sample(const Experiment& experiment, const Frames& frames, std::span<Prepared> cells)
{
    std::vector<Timed> timed;
    std::vector<Prepared*> ready;
    for (Prepared& prepared : cells) {
        if (prepared.builder == nullptr)
            continue;
        ready.push_back(&prepared);
        timed.push_back({prepared.cell.builder.name, [&, one = &prepared] {
                             const Watchdog::Hand hand(session_.watchdog(), one->number);
                             return one->cell.operation == Operation::refit
                                        ? session_.refit_once(*one->builder, frames.now(),
                                                              &one->tree)
                                        : session_.build_once(*one->builder, frames.now(),
                                                              experiment.start, &one->tree);
                         }});
    }
    std::vector<Taken> taken = session_samples(
        session_, timed, {experiment.samples, experiment.warm_up, experiment.sampling}, order_);
    for (std::size_t i = 0; i < ready.size(); ++i) {
        Cell& cell = ready[i]->cell;
        cell.samples = std::move(taken[i].samples);
        cell.sampling = {.stopped = taken[i].stopped,
                         .until = experiment.sampling.until,
                         .cold = experiment.sampling.cold};
        std::string failure = std::move(taken[i].failure);
        if (failure.empty())
            failure = reason_of_failure(
                [&] { cell.check = check_again(*ready[i]->tree, std::move(cell.check)); });
        if (!failure.empty()) {
            session_.renew_queue();
            cell = unmeasured(std::move(cell), Cell::Status::failed, failure);
        }
    }
}

}  // namespace bvhbench
