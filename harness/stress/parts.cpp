// SPDX-License-Identifier: MIT
//
// The table of `stress`: scenes, and the systems that are judged over each.
#include "harness/base/failure.h"
#include "harness/judge/hard_inputs.h"
#include "harness/stress/libraries.h"
#include "harness/stress/run.h"
#include "scenes/scene.h"

namespace bvhbench {
namespace {

using enum Finding::Verdict;
using Kind = StressCell::Kind;
using Systems = std::vector<StressSystem>;

/// Returns the inputs of the command `check` as a family of scenes.
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

/// Adds a system for each builder, judged by judge(builder, scene).
template <class Judge>
void add_builders(Systems& systems, const std::vector<BuilderChoice>& builders, const Judge& judge)
{
    for (const BuilderChoice& choice : builders)
        systems.push_back(stress_system(
            system_name(choice), Kind::builder,
            library_of(find_builder(choice.name).is_library, choice.name),
            [choice, judge](SceneUnderStress& scene) { return judge(choice, scene); }));
}

/// Adds a system for each pipeline, judged by judge(pipeline, scene).
template <class Judge>
void add_pipelines(Systems& systems, const std::vector<StressPipeline>& pipelines,
                   const Judge& judge)
{
    for (const StressPipeline& choice : pipelines)
        systems.push_back(stress_system(
            system_name(choice.builder, choice.collider), Kind::collider,
            library_of(choice.is_library, choice.collider.name),
            [choice, judge](SceneUnderStress& scene) { return judge(choice, scene); }));
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

std::vector<BuilderChoice> builders_in_formats(bool quick)
{
    std::vector<BuilderChoice> builders;
    for (const BuilderEntry& entry : builder_catalog())
        for (const BoxFormat& format : box_formats())
            if (entry.make != nullptr &&
                (format.number == BOX_F32 ||
                 (entry.takes_formats && (!quick || entry.name == builder_in_formats))))
                builders.push_back(in_format(entry.name, format.name));
    return builders;
}

/// This program never runs on a vertex that is not finite: loading must fail with a sentence that names the vertex.
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

/// Judges a query past 2^24 leaves without the narrow phase, since the triangles have no area.
Findings judge_large_query(Session& session, StressPipeline pipeline, SceneUnderStress& scene)
{
    pipeline.collider.narrow = "none";
    const PairList& expected = scene.pairs();
    scene.input.forget();  // frees memory: the pipeline uploads its own input
    Findings findings = settled(session, false, [&]() -> Findings {
        const FoundPairs found = finder_of(session, pipeline)(scene.scene(), 0);
        return {{Invariant::pairs, judge_pairs(*found.pairs, expected)}};
    });
    // A device may lack memory at this size; refusing with one sentence is then accepted.
    if (Finding& ends = findings[Invariant::ends]; ends.detail.starts_with("out of device memory"))
        ends = {refused, 1, 0, 0, ends.detail};
    return findings;
}

/// Systems judged over ordinary scenes, repeatedly over one scene, and past 2^24 leaves.
struct SystemsBySize {
    Systems ordinary, repeated, large;
};

SystemsBySize systems_by_size(Session& session, bool quick, int repeats)
{
    // On a CPU the other form is the grouped kernels, which are meant for GPUs. On a GPU it is the chunked kernels, meant for
    // few cores: they are never used there and take minutes a scene, so they run over small scenes only.
    const bool other_forms = quick || session.device().is_cpu();
    std::vector<StressPipeline> few = stress_pipelines(session, true, other_forms);
    const std::vector<BuilderChoice> builders = device_builders(session);

    SystemsBySize all;
    add_builders(all.ordinary, builders_in_formats(quick), [&session](auto& builder, auto& scene) {
        return judge_builder(session, builder, scene, 0);
    });
    add_pipelines(all.ordinary, quick ? few : stress_pipelines(session, false, other_forms),
                  [&session](auto& pipeline, auto& scene) {
                      return judge_pipeline(session, pipeline,
                                            pipeline.collider.keep_adjacent
                                                ? scene.question()
                                                : scene.question_apart());
                  });
    add_libraries(all.ordinary, quick);

    std::erase_if(few, [](const StressPipeline& one) { return one.is_library; });
    add_builders(all.repeated, builders, [&session, repeats](auto& builder, auto& scene) {
        return judge_builder(session, builder, scene, repeats);
    });
    add_pipelines(all.repeated, few, [&session, repeats](auto& pipeline, auto& scene) {
        return judge_frames(session, pipeline, scene.scene(), repeats);
    });

    // Left out: brute, since it is the sweep that computes the expected pairs; other kernel forms; other box formats.
    std::erase_if(few, [](const StressPipeline& one) {
        return one.collider.name == "brute" || one.collider.form != KernelForm::of_device ||
               one.builder.boxes != "f32";
    });
    add_builders(all.large, builders, [&session](auto& builder, auto& scene) {
        return judge_large_build(session, builder, scene);
    });
    add_pipelines(all.large, few, [&session](auto& pipeline, auto& scene) {
        return judge_large_query(session, pipeline, scene);
    });
    return all;
}

}  // namespace

std::vector<StressPart> stress_parts(Session& session, const StressSize& size)
{
    const bool quick = size.quick;
    const int repeats = quick ? 20 : 1000;
    const auto [ordinary, repeated, large] = systems_by_size(session, quick, repeats);
    std::vector<StressPart> parts;
    const auto add = [&](std::string_view family, const StressCase& scene, Systems systems) {
        parts.push_back({std::string(family), scene, std::move(systems)});
    };
    std::vector<StressFamily> families = {hard_family};
    families.insert(families.end(), stress_families().begin(), stress_families().end());
    for (const StressFamily& family : families)
        for (const StressCase& one : family.cases(size)) {
            Systems not_finite = {stress_system("loading", Kind::host, "",
                                                [name = one.name](SceneUnderStress& scene) {
                                                    return judge_loading(name, scene.scene());
                                                })};
            add_libraries(not_finite, quick);
            add(family.name, one,
                one.is_large                  ? large
                : family.name == "not-finite" ? not_finite
                                              : ordinary);
        }
    const auto spheres = [size](uint triangles) {
        return [=] { return crossed_spheres(triangles, size.seed); };
    };
    add("layout", {"to 2^31 leaves", [] { return StressScene(); }},
        {stress_system("layout.h", Kind::host, "",
                       [size](auto&) { return judge_layout_formulas(size); })});
    const uint triangles = quick ? 500 : 5000;
    add("group-sizes", {std::to_string(triangles) + " triangles", spheres(triangles)},
        group_size_systems(session, quick));
    add("repeats", {std::to_string(repeats) + " times", spheres(1000)}, repeated);
    return parts;
}

}  // namespace bvhbench
