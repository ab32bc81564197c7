// SPDX-License-Identifier: MIT
//
// The table of `stress`: scenes, and the systems that are judged over each.
#include "collide/oracles/sweep.h"
#include "harness/base/failure.h"
#include "harness/judge/hard_inputs.h"
#include "harness/stress/libraries.h"
#include "harness/stress/run.h"
#include "scenes/finish.h"

namespace bvhbench {
namespace {

using enum Finding::Verdict;
using Kind = StressCell::Kind;
using Systems = std::vector<StressSystem>;
using Pipelines = std::vector<StressPipeline>;

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

std::string library_of(bool is_library, std::string_view name)
{
    return !is_library ? "" : name.starts_with("embree") ? "Embree" : "FCL";
}

StressSystem of_builder(Session& session, const BuilderChoice& choice, int repeats)
{
    return stress_system(system_name(choice), Kind::builder,
                         library_of(find_builder(choice.name).is_library, choice.name),
                         [&session, choice, repeats](SceneUnderStress& scene) {
                             return judge_builder(session, choice, scene, repeats);
                         });
}

template <class Judge>
StressSystem of_pipeline(const StressPipeline& pipeline, const Judge& judge)
{
    return stress_system(system_name(pipeline.builder, pipeline.collider), Kind::collider,
                         library_of(pipeline.is_library, pipeline.collider.name), judge);
}

void add_libraries(Systems& systems, bool quick)
{
    const double limit_s = quick ? 20 : 60;
    for (const PlainLibrary& library : plain_libraries())
        systems.push_back(stress_system(std::string(library.name), Kind::library,
                                        std::string(library.library),
                                        [&library, limit_s](SceneUnderStress& scene) {
                                            return judge_library(library, scene.scene(), limit_s);
                                        }));
}

/// Over a scene of an ordinary size.
Systems ordinary_systems(Session& session, const Pipelines& pipelines, bool quick)
{
    Systems systems;
    for (const BuilderEntry& entry : builder_catalog())
        for (const BoxFormat& format : box_formats())
            if (entry.make != nullptr &&
                (format.number == BOX_F32 ||
                 (entry.takes_formats && (!quick || entry.name == builder_in_formats))))
                systems.push_back(of_builder(session, in_format(entry.name, format.name), 0));
    for (const StressPipeline& pipeline : pipelines)
        systems.push_back(of_pipeline(pipeline, [&session, pipeline](SceneUnderStress& scene) {
            return judge_pipeline(
                session, pipeline,
                pipeline.collider.keep_adjacent ? scene.question() : scene.question_apart());
        }));
    add_libraries(systems, quick);
    return systems;
}

/// Ours never see a scene with a vertex that is not finite: loading it ends in one sentence that names the vertex.
Findings judge_loading(const std::string& name, const StressScene& scene)
{
    Scene loaded;
    loaded.name = name;
    loaded.faces = scene.mesh.faces;
    loaded.frames = {scene.mesh.points};
    const std::string reason = reason_of_failure([&] { finished(std::move(loaded)); });
    const bool is_named =
        reason.find("has a vertex, ") != reason.npos && reason.find("not finite") != reason.npos;
    return {{Invariant::ends, is_named ? Finding{refused, 1, 0, 0, reason}
                                       : Finding{broken, 1, 1, 0, "it was loaded: " + reason}}};
}

Systems systems_of_not_finite(const std::string& name, bool quick)
{
    Systems systems = {stress_system("loading", Kind::host, "", [name](SceneUnderStress& scene) {
        return judge_loading(name, scene.scene());
    })};
    add_libraries(systems, quick);
    return systems;
}

/// The same built and asked so often.
Systems repeated_systems(Session& session, const Pipelines& pipelines, int repeats)
{
    Systems systems;
    for (const BuilderChoice& builder : device_builders(session))
        systems.push_back(of_builder(session, builder, repeats));
    for (const StressPipeline& pipeline : pipelines)
        if (!pipeline.is_library)
            systems.push_back(
                of_pipeline(pipeline, [&session, pipeline, repeats](SceneUnderStress& scene) {
                    return judge_frames(session, pipeline, scene.scene(), repeats);
                }));
    return systems;
}

/// Past 2^24 leaves: pairs without their intersections, for of triangles without area there is nothing more to find out.
Findings judge_large_query(Session& session, const StressPipeline& pipeline,
                           SceneUnderStress& scene)
{
    const PairList& expected = scene.pairs();
    Findings findings = settled(session, false, [&]() -> Findings {
        const FoundPairs found = finder_of(session, pipeline)(scene.scene(), 0);
        return {{Invariant::pairs, judge_pairs(*found.pairs, expected)}};
    });
    // At this size a device may lack the memory; saying so in one sentence is what is held of ours then.
    if (Finding& ends = findings[Invariant::ends]; ends.detail.starts_with("out of device memory"))
        ends = {refused, 1, 0, 0, ends.detail};
    return findings;
}

Systems large_pipelines(Session& session, const Pipelines& pipelines)
{
    Systems systems;
    for (StressPipeline pipeline : pipelines) {
        // In cells of a whole scene, thousands of these triangles are one: brute would take them all against each other.
        if (pipeline.is_library || pipeline.collider.name == "brute" ||
            pipeline.collider.form != KernelForm::of_device || pipeline.builder.boxes != "f32")
            continue;
        pipeline.collider.narrow = "none";
        systems.push_back(of_pipeline(pipeline, [&session, pipeline](SceneUnderStress& scene) {
            return judge_large_query(session, pipeline, scene);
        }));
    }
    return systems;
}

}  // namespace

std::vector<StressPart> stress_parts(Session& session, const StressSize& size)
{
    const bool quick = size.quick;
    // On a CPU groups show what they do on a GPU. The kernels for few cores take minutes a scene on a GPU, where nobody runs
    // them: there they are with small scenes.
    const bool other_forms = quick || session.device().is_cpu();
    const Pipelines few = stress_pipelines(session, true, other_forms);
    const Pipelines all = quick ? few : stress_pipelines(session, false, other_forms);
    const auto shared = [](Systems systems) {
        return std::make_shared<const Systems>(std::move(systems));
    };
    const auto ordinary = shared(ordinary_systems(session, all, quick));
    const auto large = shared(large_pipelines(session, few));

    std::vector<StressPart> parts;
    const auto add_family = [&](const StressFamily& family) {
        for (const StressCase& one : family.cases(size))
            parts.push_back({std::string(family.name), one,
                             one.is_large ? large
                             : family.name == "not-finite"
                                 ? shared(systems_of_not_finite(one.name, quick))
                                 : ordinary});
    };
    add_family(hard_family);
    for (const StressFamily& family : stress_families())
        add_family(family);
    const auto spheres = [size](uint triangles) {
        return [=] { return crossed_spheres(triangles, size.seed); };
    };
    const auto layout = stress_system("layout.h", Kind::host, "",
                                      [size](auto&) { return judge_layout_formulas(size); });
    parts.push_back({"layout", {"to 2^31 leaves", [] { return StressScene(); }}, shared({layout})});
    const uint triangles = quick ? 500 : 5000;
    parts.push_back({"group-sizes",
                     {std::to_string(triangles) + " triangles", spheres(triangles)},
                     shared(group_size_systems(session, quick))});
    const int repeats = quick ? 20 : 1000;
    parts.push_back({"repeats",
                     {std::to_string(repeats) + " times", spheres(1000)},
                     shared(repeated_systems(session, few, repeats))});
    return parts;
}

}  // namespace bvhbench
