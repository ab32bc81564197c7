// SPDX-License-Identifier: MIT
#include "harness/measure/collide.h"

#include <memory>

#include "harness/judge/metrics.h"
#include "harness/measure/engine.h"
#include "harness/measure/frame_verdict.h"
#include "process/watchdog.h"

namespace bvhbench {
namespace {

/// Creates the pipeline if it does not exist and runs the frame once, so that the frame can be timed. Returns the stages.
std::vector<StageTime> prepare(Session& session, PipelineState& one, const FrameOfPipelines& frame,
                               Cell& cell)
{
    const watchdog::Watch watch;
    if (one.pipeline == nullptr)
        one.pipeline =
            std::make_unique<Pipeline>(session, cell.builder, cell.collider, frame.input);
    if (!one.pipeline->collider().needs_tree())
        cell.builder = {.name = "none"};
    one.pipeline->begin_frame(frame.motions);
    std::vector<StageTime> stages;
    cell.first.run_ns = host_ns([&] { stages = one.pipeline->prepare(frame.input); });
    return stages;
}

/// Writes the quality of the tree that the pipeline has queried to the cell. If an earlier cell has a tree of the same builder and
/// order, it is that one's: where leaf boxes are stored changes no tree.
void count_quality_of_query(const Pipeline& pipeline, const Input& input, const NodeCosts& costs,
                            std::span<const Measurement> earlier, Cell& cell)
{
    if (pipeline.tree() == nullptr)
        return;
    if (input.objects.size() > 1) {
        cell.left_out["sah_cost"] = cell.left_out["epo"] = "the frame has several trees";
        return;
    }
    for (const Measurement& other : earlier) {
        BuilderChoice same = other.cell.builder;
        same.sorted_leaves = cell.builder.sorted_leaves;
        if (same != cell.builder || !other.cell.counters.contains("sah_cost"))
            continue;
        for (const char* counter : {"sah_inner", "sah_leaf", "sah_cost", "sibling_overlap",
                                    "depth_max", "depth_mean", "epo_inner", "epo_leaf", "epo"})
            if (const auto found = other.cell.counters.find(counter);
                found != other.cell.counters.end())
                cell.counters.insert(*found);
        return;
    }
    const HostTree tree = pipeline.tree()->to_host_tree();
    count_quality(cell, tree, costs);
    if (!input.is_swept())
        count_end_point_overlap(cell, tree, input.points, input.faces, costs);
}

}  // namespace

std::vector<Cell> run_frame(Session& session, const CollideTask& task, std::span<PipelineState> all,
                            const FrameOfPipelines& frame, int& order, Found& found)
{
    const Input& input = frame.input;
    FrameVerdict verdict(session, frame);
    verdict.begin(all.front().choice.collider);  // runs while the first pipeline is prepared
    Engine engine(session, {task.samples, task.warm_up, task.sampling}, order, frame.note);
    std::vector<Measurement> measurements(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
        PipelineState& one = all[k];
        Measurement& measurement = measurements[k];
        measurement = {.cell = planned_cell(task, one.choice),
                       .number = frame.number + '/' + std::to_string(k)};
        Cell& cell = measurement.cell;
        cell.scene = frame.scene;
        cell.features = frame.features;
        if (one.status == Cell::Status::measured && one.pipeline == nullptr)
            if (one.reason = frame.contest.why_not(cell); !one.reason.empty())
                one.status = Cell::Status::skipped;
        if (one.status != Cell::Status::measured) {
            engine.refuse(measurement.cell, one.status, one.reason);
            continue;
        }
        if (frame.note)
            frame.note(one.choice.collider.name + " over " + one.choice.builder.name + ", cell " +
                           std::to_string(k + 1) + " of " + std::to_string(all.size()),
                       0);
        engine.prepare(measurement, [&] {
            verdict.require_memory(cell.collider);
            measurement.stages_before = prepare(session, one, frame, cell);
            cell.counters = one.pipeline->counters();
            cell.counters.merge(one.pipeline->transfers(input));
            verdict.judge(*one.pipeline, cell, found);
            if (task.quality)
                count_quality_of_query(*one.pipeline, input, *task.quality,
                                       std::span(measurements).first(k), cell);
        });
        measurement.once = [&] {
            const watchdog::Watch watch;
            return one.pipeline->once(input);
        };
        if (find_collider(one.choice.collider.name).outside != nullptr)
            measurement.no_copies = no_copies_of_outside;
        if (one.pipeline != nullptr && one.pipeline->is_on_device()) {
            measurement.upload = [&] { one.pipeline->upload(input); };
            measurement.read_back = [&] { one.pipeline->read_back(); };
        }
        // Another pipeline may have used the same builder's tree since the last sample, so the frame runs once more.
        measurement.judge_again = [&] {
            one.pipeline->once(input);
            verdict.judge(*one.pipeline, cell, found);
            frame.contest.count_areas(*one.pipeline, input, cell);
        };
        if (engine.sample_first(measurement, frame.contest) &&
            frame.contest.can_judge(one.choice.collider))
            one.pipeline.reset();  // it is far behind; frees its memory
    }
    verdict.wait();  // needed even if no pipeline has asked for it
    std::vector<Cell> cells = engine.sample(measurements);
    for (std::size_t k = 0; k < all.size(); ++k) {
        all[k].status = measurements[k].cell.status;
        all[k].reason = measurements[k].cell.reason;
    }
    frame.contest.end_frame(cells);
    for (std::size_t k = 0; k < all.size(); ++k)
        if (std::string why = frame.contest.why_lost(k); !why.empty())
            all[k] = {
                .choice = all[k].choice, .status = Cell::Status::skipped, .reason = std::move(why)};
    return cells;
}

}  // namespace bvhbench
