// SPDX-License-Identifier: MIT
//
// Cells of builds and refits: the builders of a scene are prepared and checked, then sampled by turns.
#include <algorithm>
#include <utility>

#include "builders/device_tree.h"
#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/base/failure.h"
#include "harness/judge/check.h"
#include "harness/judge/metrics.h"
#include "harness/measure/contest.h"
#include "harness/measure/engine.h"
#include "harness/measure/frames.h"
#include "harness/measure/run.h"
#include "scenes/face_order.h"

namespace bvhbench {
namespace {

/// A scene, and those of its frames that an experiment needs on the device.
///
/// Without refits that is the first frame. With refits every cell is about the second frame, whose points have moved: its tree
/// is built over that frame, or built over the first and refitted.
struct Frames {
    Scene scene;
    Input now;     ///< the frame that cells are about
    Input before;  ///< the frame that trees are refitted from

    /// Reads the scene of this name, tells its facts and uploads the frames as one object. Blocks until done. Throws what load_scene
    /// throws, and Unavailable if a refit is asked for and there is no second frame.
    void load(Session& session, const Experiment& experiment, SceneFacts& facts)
    {
        scene = scene_called(facts.name, experiment.may_stand_in, session.scenes());
        const std::size_t frame = experiment.has(Operation::refit) ? 1 : 0;
        if (frame >= scene.frames.size())
            throw Unavailable("a refit needs a second frame, and scene '" + scene.name +
                              "' has one; bend:" + scene.name + " has two");
        facts = facts_of(scene, facts.name, frame);
        scene = in_file_order(std::move(scene));
        now = upload_frame(session, scene, frame, false);
        if (frame > 0)
            before = upload_frame(session, scene, frame - 1, false);
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
    const Input& first = refits ? frames.before : frames.now;
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
        session.refit_once(builder, frames.now, &built.tree);
        const HostTree before = std::exchange(tree, built.tree->to_host_tree());
        cell.check = check_refit(tree, before, frames.now, std::move(cell.check));
    } else if (experiment.start == Start::from_sorted_leaves) {
        session.build_once(builder, first, experiment.start, &built.tree);
        cell.check = check_again(*built.tree, first, std::move(cell.check));
    }
    count_quality(cell, tree, costs);
    if (experiment.quality)
        count_end_point_overlap(cell, tree, frames.now.points, frames.now.faces, costs);
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

void Run::scene(const Experiment& experiment, const std::string& name,
                std::span<const BuilderChoice> builders, Progress& progress)
{
    const std::string number = std::to_string(number_) + '/';
    if (results_.pass(builders.size() * experiment.operations.size() *
                      experiment.sampling.caches.size()))
        return;
    Frames frames;
    Cell empty{.experiment = experiment.name, .scene = {.name = name}};
    std::string no_scene;
    const auto load = [&] { frames.load(session_, experiment, empty.scene); };
    if (experiment.needs_scene)
        load();
    else
        no_scene = reason_of_failure(load);

    Oracle oracle(session_, frames.now), oracle_before(session_, frames.before);
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
            engine.refuse(measurement.cell, no_scene.empty() ? status : Cell::Status::skipped,
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
                       ? session_.refit_once(*built[k].builder, frames.now, &built[k].tree)
                       : session_.build_once(*built[k].builder, frames.now, experiment.start,
                                             &built[k].tree);
        };
        measurement.upload = [&] {
            frames.now.device_points.upload(session_.queue().cl(), frames.now.points);
        };
        if (entry.outside != nullptr)
            measurement.no_copies = no_copies_of_outside;
        measurement.judge_again = [&, k] {
            measurement.cell.check =
                check_again(*built[k].tree, frames.now, std::move(measurement.cell.check));
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
