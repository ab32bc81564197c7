// SPDX-License-Identifier: MIT
#include "harness/base/failure.h"
#include "harness/stress/parts.h"

namespace bvhbench {
namespace {

constexpr int most_repeats = 1000, few_repeats = 20;

}  // namespace

void stress_repeats(Session& session, const StressTask& task, const AddStressCell& add)
{
    const int repeats = task.size.quick ? few_repeats : most_repeats;
    StressCell cell;
    cell.family = "repeats";
    cell.scene = std::to_string(repeats) + " times";
    const StressScene scene = crossed_spheres(1000, task.size.seed);
    cell.triangles = static_cast<std::int64_t>(scene.mesh.faces.size());
    const Input input =
        upload(session.device(), session.queue(), scene.mesh.points, scene.mesh.faces);
    Oracle oracle(session, input);
    for (const BuilderEntry& entry : builder_catalog()) {
        cell.system = entry.name;
        if (!builds_on_device(session, entry) || !task.wants(cell))
            continue;
        StressCell done = cell;
        done.findings =
            judge_builder(session, {.name = std::string(entry.name)}, input, oracle, repeats);
        add(std::move(done));
    }
    cell.kind = StressCell::Kind::collider;
    for (const StressPipeline& pipeline :
         stress_pipelines(session, true, wants_other_forms(session, task.size))) {
        cell.system = system_name(pipeline.builder, pipeline.collider);
        if (pipeline.is_library || !task.wants(cell))
            continue;
        StressCell done = cell;
        done.findings = judge_frames(session, pipeline, scene, repeats);
        add(std::move(done));
    }
}

}  // namespace bvhbench
