// SPDX-License-Identifier: MIT
#include <algorithm>
#include <deque>
#include <future>
#include <map>
#include <thread>

#include "collide/oracles/sweep.h"
#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/base/failure.h"
#include "harness/judge/check.h"
#include "harness/stress/parts.h"

namespace bvhbench {
namespace {

StressCell cell_of(const StressFamily& family, const StressCase& one, const StressScene& scene)
{
    StressCell cell;
    cell.family = family.name;
    cell.scene = one.name;
    cell.triangles = static_cast<std::int64_t>(scene.mesh.faces.size());
    return cell;
}

/// Checks that run beside builds, as many at once as cores and memory allow.
class LateChecks {
public:
    LateChecks(std::size_t triangles, const AddStressCell& add) : add_(add)
    {
        const std::uint64_t given = host_memory_left() / 2;
        const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
        most_ = std::clamp<std::size_t>(given / std::max<std::size_t>(1, check_bytes(triangles)), 1,
                                        cores);
    }

    void begin(StressCell cell, LateFindings late)
    {
        if (waiting_.size() == most_)
            end_first();
        cell.findings = std::move(late.so_far);
        waiting_.push_back(
            {std::move(cell), std::async(std::launch::async, std::move(late.check))});
    }

    void end_all()
    {
        while (!waiting_.empty())
            end_first();
    }

private:
    struct Waiting {
        StressCell cell;
        std::future<LateFindings::Tree> tree;
    };

    void end_first()
    {
        Waiting first = std::move(waiting_.front());
        waiting_.pop_front();
        const LateFindings::Tree tree = first.tree.get();
        join(first.cell.findings, tree.findings);
        const std::string oracle(find_builder(first.cell.system).oracle);
        if (!oracle.empty() && !tree.findings.empty() &&
            hashes_.try_emplace(oracle, tree.hash).first->second != tree.hash)
            first.cell.findings[Invariant::layout] = {
                Finding::Verdict::broken, 1, 0, 0,
                "it is another tree than another builder's, which must leave the same"};
        add_(std::move(first.cell));
    }

    const AddStressCell& add_;
    std::size_t most_ = 1;
    std::deque<Waiting> waiting_;
    std::map<std::string, std::uint64_t> hashes_;  ///< of trees, by the reference's name
};

/// Pairs without their intersections: of triangles without area there is nothing more to find out at this size.
Findings judge_large_query(Session& session, StressPipeline pipeline, const StressScene& scene,
                           const PairList& expected)
{
    pipeline.collider.narrow = "none";
    Findings findings;
    const std::string failure = reason_of_failure([&] {
        findings[Invariant::pairs] =
            judge_pairs(*finder_of(session, pipeline)(scene, 0).pairs, expected);
    });
    findings[Invariant::ends] = {Finding::Verdict::holds, 1};
    if (!failure.empty()) {
        session.renew_queue();
        // At this size a device may lack the memory; saying so in one sentence is what is held of ours then.
        findings[Invariant::ends] = failure.starts_with("out of device memory")
                                        ? Finding{Finding::Verdict::refused, 1, 0, 0, failure}
                                        : Finding{Finding::Verdict::broken, 1, 1, 0, failure};
    }
    return findings;
}

}  // namespace

void stress_large(Session& session, const StressTask& task, const StressFamily& family,
                  const StressCase& one, const AddStressCell& add)
{
    std::vector<BuilderChoice> builders;
    for (const BuilderEntry& entry : builder_catalog()) {
        StressCell cell;
        cell.family = family.name, cell.scene = one.name, cell.system = entry.name;
        if (builds_on_device(session, entry) && task.wants(cell))
            builders.push_back({.name = std::string(entry.name)});
    }
    std::vector<StressPipeline> pipelines = stress_pipelines(session, true, false);
    std::erase_if(pipelines, [&](const StressPipeline& pipeline) {
        StressCell cell;
        cell.family = family.name, cell.scene = one.name;
        cell.system = system_name(pipeline.builder, pipeline.collider);
        // In cells of a whole scene, thousands of these triangles are one.
        return pipeline.is_library || pipeline.collider.name == "brute" ||
               pipeline.builder.boxes != "f32" || !task.wants(cell);
    });
    if (builders.empty() && pipelines.empty())
        return;

    const StressScene scene = one.make();
    std::future<PairList> expected = std::async(std::launch::async, [&] {
        return pipelines.empty() ? PairList()
                                 : touching_pairs(scene.mesh.points, scene.mesh.faces, true);
    });
    {
        const Input input =
            upload(session.device(), session.queue(), scene.mesh.points, scene.mesh.faces);
        LateChecks checks(scene.mesh.faces.size(), add);
        for (const BuilderChoice& builder : builders) {
            StressCell cell = cell_of(family, one, scene);
            cell.system = system_name(builder);
            checks.begin(std::move(cell), build_large(session, builder, input));
        }
        checks.end_all();
    }
    const PairList pairs = expected.get();
    for (const StressPipeline& pipeline : pipelines) {
        StressCell cell = cell_of(family, one, scene);
        cell.system = system_name(pipeline.builder, pipeline.collider);
        cell.kind = StressCell::Kind::collider;
        cell.findings = judge_large_query(session, pipeline, scene, pairs);
        add(std::move(cell));
    }
}

}  // namespace bvhbench
