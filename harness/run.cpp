// SPDX-License-Identifier: MIT
#include "harness/run.h"

#include <algorithm>

#include "builders/orders.h"
#include "device/copy_rate.h"
#include "geometry/error.h"
#include "harness/check.h"
#include "harness/failure.h"
#include "harness/interrupt.h"
#include "harness/metrics.h"
#include "harness/provenance.h"
#include "harness/sampler.h"

namespace bvhbench {
namespace {

RunFacts measured_facts(Session& session, std::vector<std::string> command)
{
    RunFacts facts = run_facts(session.device(), std::move(command));
    const std::string failure = reason_of_failure([&] {
        const CopyRate rate = measure_copy_rate(session.programs(), session.queue());
        facts.copy_rate_bytes_per_s = rate.bytes_per_s;
        facts.copy_rate_buffer_bytes = static_cast<std::int64_t>(rate.buffer_bytes);
    });
    if (!failure.empty())
        session.renew_queue();  // a device without room for the copy can still build small trees
    return facts;
}

Scene scene_of(const Experiment& experiment, const std::string& name, const SceneLibrary& library)
{
    if (const DataSet* set = find_data_set(name); set != nullptr && experiment.may_stand_in)
        return load_or_stand_in(*set, library);
    return load_scene(name, library);
}

SceneFacts facts_of(const Scene& scene, const std::string& name)
{
    return {.name = name,
            .triangles = scene.triangle_count(),
            .vertices = static_cast<std::int64_t>(scene.frames.front().size()),
            .objects = static_cast<std::int64_t>(scene.objects.size()),
            .frame = 0,
            .source = scene.source,
            .stand_in_for = scene.stand_in_for,
            .outlier = scene.outlier,
            .content_hash = scene.content_hash};
}

Cell unmeasured(Cell cell, Cell::Status status, std::string reason)
{
    cell.status = status;
    cell.reason = std::move(reason);
    cell.samples.clear();
    return cell;
}

std::vector<BuilderChoice> chosen(const Experiment& experiment, const std::string& scene,
                                  const CellFilter& filter)
{
    std::vector<BuilderChoice> builders;
    for (const BuilderChoice& builder : experiment.builders)
        if (!filter || std::regex_search(scene + '/' + builder.name, *filter))
            builders.push_back(builder);
    return builders;
}

}  // namespace

namespace {

/// Why this program cannot make the builder; empty if it can. Throws BadUsage for one that must be there.
std::string absence(const BuilderChoice& choice)
{
    try {
        const BuilderEntry& entry = find_builder(choice.name);
        find_order(choice.order);
        return entry.make == nullptr ? std::string(entry.absent) : std::string();
    } catch (const BadUsage& error) {
        if (!choice.if_there)
            throw;
        const std::string sentence = error.what();
        return sentence.substr(0, sentence.find(';'));  // without what there is instead
    }
}

/// Verdict and quality of the tree just built, which is spelled out once for both. A tree that is wrong has no
/// quality.
void judge(Cell& cell, const Tree& built, const Input& input, Oracle& oracle, bool with_overlap)
{
    const HostTree tree = built.spelled_out();
    cell.check = check_tree(tree, input, cell.builder, oracle);
    if (cell.check.verdict == Check::Verdict::differs)
        return;
    cell.counters.merge(tree_counters(tree));
    if (with_overlap)
        cell.counters.merge(overlap_counters(tree, input.points, input.faces));
}

}  // namespace

/// A cell on its way to being measured; without a builder it is finished already.
struct Run::Prepared {
    Cell cell;
    Builder* builder = nullptr;
    const Tree* tree = nullptr;
};

Run::Run(Session& session, std::filesystem::path out, std::vector<std::string> command)
    : session_(session), results_(std::move(out), measured_facts(session, std::move(command)))
{}

bool Run::has_differing_cell() const
{
    const auto& cells = document().cells;
    return std::any_of(cells.begin(), cells.end(), [](const Cell& cell) {
        return cell.status == Cell::Status::measured &&
               cell.check.verdict == Check::Verdict::differs;
    });
}

void Run::experiment(const Experiment& experiment, const CellFilter& filter)
{
    Progress progress(experiment.scenes.size());
    for (const std::string& name : experiment.scenes) {
        throw_if_interrupted();
        const std::vector<BuilderChoice> builders = chosen(experiment, name, filter);
        progress.step(experiment.name + ": " + name);
        if (!builders.empty())
            scene(experiment, name, builders, progress);
    }
}

void Run::scene(const Experiment& experiment, const std::string& name,
                std::span<const BuilderChoice> builders, Progress& progress)
{
    Scene scene;
    Input input;
    Cell empty;
    empty.experiment = experiment.name;
    empty.scene.name = name;
    empty.warm_up = experiment.warm_up;
    const std::string no_scene = reason_of_failure([&] {
        scene = scene_of(experiment, name, session_.scenes());
        empty.scene = facts_of(scene, name);
        input = upload(session_.device(), session_.queue(), scene.frames.front(), scene.faces);
    });

    Oracle oracle(session_, input);
    std::vector<Prepared> cells;
    for (const BuilderChoice& builder : builders) {
        throw_if_interrupted();
        empty.builder = builder;
        if (!no_scene.empty())
            cells.push_back({unmeasured(empty, Cell::Status::skipped, no_scene)});
        else
            cells.push_back(prepare(experiment, input, empty, oracle));
    }
    progress.note(experiment.name + ": " + name + ", sampling");
    sample(experiment, input, cells);
    for (Prepared& cell : cells)
        results_.add(std::move(cell.cell));
}

Run::Prepared Run::prepare(const Experiment& experiment, const Input& input, Cell cell,
                           Oracle& oracle)
{
    if (std::string why = absence(cell.builder); !why.empty())
        return {unmeasured(std::move(cell), Cell::Status::skipped, std::move(why))};

    Prepared prepared;
    const std::string failure = reason_of_failure([&] {
        Builder& builder = session_.builder(cell.builder);
        builder.reserve(input.triangle_count());
        session_.build_once(builder, input, Start::from_triangles, &prepared.tree);
        judge(cell, *prepared.tree, input, oracle, experiment.quality);
        if (experiment.start == Start::from_sorted_leaves) {
            session_.build_once(builder, input, experiment.start, &prepared.tree);
            cell.check = check_again(*prepared.tree, std::move(cell.check));
        }
        const Footprint footprint = builder.reserved();
        cell.counters["nodes_count"] = static_cast<double>(prepared.tree->node_count());
        cell.counters["tree_bytes"] = static_cast<double>(footprint.tree_bytes);
        cell.counters["scratch_bytes"] = static_cast<double>(footprint.scratch_bytes);
        prepared.builder = &builder;
    });
    if (!failure.empty()) {
        session_.renew_queue();
        return {unmeasured(std::move(cell), Cell::Status::failed, failure)};
    }
    prepared.cell = std::move(cell);
    return prepared;
}

void Run::sample(const Experiment& experiment, const Input& input, std::span<Prepared> cells)
{
    std::vector<Timed> timed;
    std::vector<Prepared*> ready;
    for (Prepared& cell : cells) {
        if (cell.builder == nullptr)
            continue;
        ready.push_back(&cell);
        timed.push_back({cell.cell.builder.name, [&, builder = cell.builder, tree = &cell.tree] {
                             return session_.build_once(*builder, input, experiment.start, tree);
                         }});
    }
    std::vector<Taken> taken = take_samples(timed, experiment.samples, experiment.warm_up, order_);
    for (std::size_t i = 0; i < ready.size(); ++i) {
        Cell& cell = ready[i]->cell;
        cell.samples = std::move(taken[i].samples);
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
