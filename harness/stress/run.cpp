// SPDX-License-Identifier: MIT
#include "harness/stress/run.h"

#include <algorithm>
#include <future>

#include "geometry/error.h"
#include "harness/base/failure.h"
#include "harness/base/terminal.h"
#include "harness/judge/hard_inputs.h"
#include "harness/stress/libraries.h"
#include "scenes/finish.h"

namespace bvhbench {
namespace {

using enum Finding::Verdict;

constexpr double quick_limit_s = 20, full_limit_s = 60;  ///< of a library

/// What builders are checked over, as a family of scenes.
std::vector<StressCase> hard_cases(const StressSize& size)
{
    std::vector<StressCase> cases;
    for (const HardInput& input : hard_inputs()) {
        const bool is_crowded = input.name == "identical" || input.name == "same-centre" ||
                                input.name == "negative-zero";  // all on one line
        const uint triangles = is_crowded ? size.crowded_triangles() : size.triangles();
        cases.push_back({std::string(input.name), [=] { return single(input.make(triangles)); }});
    }
    return cases;
}

constexpr StressFamily hard_family = {
    "hard", "those of `check`: equal boxes, equal centres, flat, -0, huge and more", hard_cases};

bool is_all_finite(const StressScene& scene)
{
    return finite_part(scene).original.size() == scene.mesh.faces.size();
}

/// What stops all systems, such as a scene that the device has no room for, is a finding too.
void guarded(Session& session, StressCell cell, const AddStressCell& add,
             const std::function<void()>& work)
{
    const std::string failure = reason_of_failure(work);
    if (failure.empty())
        return;
    session.renew_queue();
    cell.system = "device";
    cell.kind = StressCell::Kind::host;
    cell.library.clear();
    cell.findings = {{Invariant::ends, {broken, 1, 1, 0, failure}}};
    add(std::move(cell));
}

/// All systems over one scene.
class SceneStress {
public:
    SceneStress(Session& session, const StressTask& task,
                const std::vector<StressPipeline>& pipelines, const AddStressCell& add)
        : session_(session), task_(task), pipelines_(pipelines), add_(add)
    {}

    void over(const StressFamily& family, const StressCase& one)
    {
        cell_ = {};
        cell_.family = family.name;
        cell_.scene = one.name;
        const StressScene scene = one.make();
        cell_.triangles = static_cast<std::int64_t>(scene.mesh.faces.size());
        // Meanwhile, for they need no device.
        auto libraries = std::async(std::launch::async, [&] { return of_libraries(scene); });
        if (is_all_finite(scene)) {
            const StressCell as_it_is = cell_;
            guarded(session_, as_it_is, add_, [&] { of_builders(scene); });
            of_pipelines(scene);
        } else {
            of_loading(scene);
        }
        for (StressCell& cell : libraries.get())
            add_(std::move(cell));
    }

private:
    bool begins(std::string system, StressCell::Kind kind, std::string library = {})
    {
        cell_.system = std::move(system);
        cell_.kind = kind;
        cell_.library = std::move(library);
        return task_.wants(cell_);
    }

    void done(Findings findings)
    {
        StressCell cell = cell_;
        cell.findings = std::move(findings);
        add_(std::move(cell));
    }

    void of_builders(const StressScene& scene)
    {
        std::optional<Input> input;
        std::optional<Oracle> oracle;
        for (const BuilderEntry& entry : builder_catalog())
            for (const BoxFormat& format : box_formats()) {
                const BuilderChoice choice = in_format(entry.name, format.name);
                const bool is_had = format.number == BOX_F32 ||
                                    (entry.takes_formats &&
                                     (!task_.size.quick || entry.name == builder_in_formats));
                if (entry.make == nullptr || !is_had ||
                    !begins(system_name(choice), StressCell::Kind::builder,
                            entry.is_library ? library_of(entry.name) : ""))
                    continue;
                if (!input) {
                    input = upload(session_.device(), session_.queue(), scene.mesh.points,
                                   scene.mesh.faces);
                    oracle.emplace(session_, *input);
                }
                done(judge_builder(session_, choice, *input, *oracle, 0));
            }
    }

    void of_pipelines(const StressScene& scene)
    {
        std::optional<StressQuestion> question, apart;
        for (const StressPipeline& pipeline : pipelines_) {
            if (!begins(system_name(pipeline.builder, pipeline.collider),
                        StressCell::Kind::collider,
                        pipeline.is_library ? library_of(pipeline.collider.name) : ""))
                continue;
            if (!question)
                question = question_of(scene, task_.size.seed);
            if (!pipeline.collider.keep_adjacent && !apart)
                apart = without_adjacent(*question);
            done(judge_pipeline(session_, pipeline,
                                pipeline.collider.keep_adjacent ? *question : *apart));
        }
    }

    /// Ours never see such a scene: loading it ends in one sentence that names the vertex.
    void of_loading(const StressScene& scene)
    {
        if (!begins("loading", StressCell::Kind::host))
            return;
        Scene loaded;
        loaded.name = cell_.scene;
        loaded.faces = scene.mesh.faces;
        loaded.frames = {scene.mesh.points};
        const std::string reason = reason_of_failure([&] { finished(std::move(loaded)); });
        const bool is_named = reason.find("has a vertex, ") != reason.npos &&
                              reason.find("not finite") != reason.npos;
        done({{Invariant::ends, is_named ? Finding{refused, 1, 0, 0, reason}
                                         : Finding{broken, 1, 1, 0, "it was loaded: " + reason}}});
    }

    std::vector<StressCell> of_libraries(const StressScene& scene) const
    {
        std::vector<StressCell> cells;
        for (const PlainLibrary& library : plain_libraries()) {
            StressCell cell = cell_;
            cell.system = library.name;
            cell.kind = StressCell::Kind::library;
            cell.library = library.library;
            if (!task_.wants(cell))
                continue;
            cell.findings =
                judge_library(library, scene, task_.size.quick ? quick_limit_s : full_limit_s);
            cells.push_back(std::move(cell));
        }
        return cells;
    }

    static std::string library_of(std::string_view name)
    {
        return name.starts_with("embree") ? "Embree" : "FCL";
    }

    Session& session_;
    const StressTask& task_;
    const std::vector<StressPipeline>& pipelines_;
    const AddStressCell& add_;
    StressCell cell_;
};

}  // namespace

void stress_all(Session& session, const StressTask& task, const AddStressCell& add)
{
    std::vector<const StressFamily*> families = {&hard_family};
    for (const StressFamily& family : stress_families())
        families.push_back(&family);
    std::size_t total = 3;
    for (const StressFamily* family : families)
        total += family->cases(task.size).size();
    Progress progress(total);

    const std::vector<StressPipeline> pipelines =
        stress_pipelines(session, task.size.quick, wants_other_forms(session, task.size));
    SceneStress scenes(session, task, pipelines, add);
    const auto part = [&](std::string_view family, const std::string& scene,
                          const std::function<void()>& work) {
        progress.step(std::string(family) + ", " + scene);
        StressCell cell;
        cell.family = family;
        cell.scene = scene;
        guarded(session, std::move(cell), add, work);
    };
    for (const StressFamily* family : families)
        for (const StressCase& one : family->cases(task.size))
            part(family->name, one.name, [&] {
                if (one.is_large)
                    stress_large(session, task, *family, one, add);
                else
                    scenes.over(*family, one);
            });
    part("layout", "arithmetic", [&] { stress_layout(task, add); });
    part("group-sizes", "all", [&] { stress_group_sizes(session, task, add); });
    part("repeats", "all", [&] { stress_repeats(session, task, add); });
}

}  // namespace bvhbench
