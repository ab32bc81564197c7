// SPDX-License-Identifier: MIT
#include "harness/accuracy/scene_input.h"

#include "builders/device_tree.h"
#include "geometry/host_memory.h"
#include "harness/base/failure.h"
#include "harness/judge/check.h"
#include "harness/judge/differences.h"
#include "harness/judge/metrics.h"

namespace bvhbench {

void for_each_scene(const AxisRun& run, std::string_view axis,
                    std::initializer_list<const char*> own,
                    const std::function<void(const SceneFacts& facts, const Input& input)>& measure,
                    bool by_objects)
{
    std::vector<std::string> scenes = run.task.scenes;
    if (scenes.empty())
        scenes.assign(own.begin(), own.end());
    for (const std::string& scene : scenes) {
        run.progress.note("accuracy, " + std::string(axis) + ": " + scene);
        SceneFacts facts;
        facts.name = scene;
        bool is_there = false;
        const std::string failure = reason_of_failure([&] {
            Frames frames;
            frames.load(Experiment{}, scene, run.session.scenes());
            facts = frames.facts();
            frames.upload(run.session, by_objects);
            is_there = true;
            measure(facts, frames.now());
        });
        if (failure.empty())
            continue;
        run.session.renew_queue();
        Cell cell = accuracy_cell(std::string(axis), "all", facts);
        cell.status = is_there ? Cell::Status::failed : Cell::Status::skipped;
        cell.reason = failure;
        run.add(std::move(cell));
    }
}

HostTree built_tree(Session& session, const BuilderChoice& choice, const Input& input)
{
    Builder& builder = session.builder(choice);
    require_host_memory("a tree", check_bytes(input.triangle_count()));
    builder.reserve(input.triangle_count());
    const Tree* tree = nullptr;
    session.build_once(builder, input, Start::from_triangles, &tree);
    return tree->spelled_out();
}

std::optional<double> forest_cost(Session& session, const BuilderChoice& choice, const Input& input)
{
    Builder& builder = session.builder(choice);
    builder.reserve_objects(object_sizes(input));
    const Tree* built = nullptr;
    session.build_once(builder, input, Start::from_triangles, &built);
    const auto& forest = dynamic_cast<const DeviceTree&>(*built);
    double cost = 0, area = 0;
    for (uint object = 0; object < forest.objects.size(); ++object) {
        const HostTree tree = forest.spelled_out_object(object);
        const double root = surface_area(tree.nodes.front().box);
        if (const auto sums = area_sums(tree)) {
            cost += root * sums->cost();
            area += root;
        }
    }
    return area > 0 ? std::optional(cost / area) : std::nullopt;
}

std::unique_ptr<Pipeline> settled_pipeline(Session& session, Cell& cell, const Input& input)
{
    auto pipeline = std::make_unique<Pipeline>(session, cell.builder, cell.collider, input);
    pipeline->begin_frame({});
    pipeline->settle(input);
    cell.counters = pipeline->counters();
    return pipeline;
}

void judge_pairs(const Pipeline& pipeline, const PairList& right, const std::string& against,
                 Cell& cell)
{
    const PairList found = pipeline.pairs();
    const Differences wrong = differences(found, right);
    cell.counters["missed_count"] = static_cast<double>(wrong.missed);
    cell.counters["false_count"] = static_cast<double>(wrong.false_ones);
    cell.check.verdict = wrong == Differences{} ? Check::Verdict::agrees : Check::Verdict::differs;
    cell.check.against = against;
    cell.check.pairs_hash = found.hash();
    if (wrong != Differences{})
        cell.check.detail = std::to_string(wrong.missed) + " pairs missed, " +
                            std::to_string(wrong.false_ones) + " false";
}

}  // namespace bvhbench
