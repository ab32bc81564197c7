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

/// Adds a system for each choice.
void add_systems(Systems& systems, const std::vector<PipelineChoice>& choices,
                 Findings (*judge)(SceneUnderStress&, const PipelineChoice&))
{
    for (const PipelineChoice& choice : choices) {
        const std::string& name = is_builder(choice) ? choice.builder.name : choice.collider.name;
        const std::string library = name.starts_with("embree") ? "Embree" : "FCL";
        systems.push_back({system_name(choice), is_builder(choice) ? Kind::builder : Kind::collider,
                           is_library(choice) ? library : "",
                           [=](SceneUnderStress& scene) { return judge(scene, choice); }});
    }
}

void add_libraries(Systems& systems, bool quick)
{
    const double limit_s = quick ? 20 : 60;
    for (const PlainLibrary& library : plain_libraries())
        systems.push_back({std::string(library.name), Kind::library, std::string(library.library),
                           [&library, limit_s](SceneUnderStress& scene) {
                               return judge_library(library, scene.scene(), limit_s);
                           }});
}

std::vector<PipelineChoice> builders_in_formats(bool quick)
{
    std::vector<PipelineChoice> builders;
    for (const BuilderEntry& entry : builder_catalog())
        for (const BoxFormat& format : box_formats())
            if (entry.make != nullptr &&
                (format.number == BOX_F32 ||
                 (entry.takes_formats && (!quick || entry.name == builder_in_formats))))
                builders.push_back({in_format(entry.name, format.name), {}});
    return builders;
}

/// This program never runs on a vertex that is not finite: loading must fail with a sentence that names the vertex.
Findings judge_loading(SceneUnderStress& scene)
{
    Scene loaded;
    loaded.name = scene.name;
    loaded.faces = scene.scene().mesh.faces;
    loaded.frames = {scene.scene().mesh.points};
    const std::string reason = reason_of_failure([&] { finished(std::move(loaded)); });
    const bool is_named =
        reason.find("has a vertex, ") != reason.npos && reason.find("not finite") != reason.npos;
    return {{Invariant::ends, is_named ? Finding{refused, 1, 0, 0, reason}
                                       : Finding{broken, 1, 1, 0, "it was loaded: " + reason}}};
}

}  // namespace

std::vector<StressPart> stress_parts(Session& session, const StressSize& size)
{
    const bool quick = size.quick;
    // On a CPU the other form is the grouped kernels, which are meant for GPUs. On a GPU it is the chunked kernels, meant for
    // few cores: they are never used there and take minutes a scene, so they run over small scenes only.
    const bool other_forms = quick || session.device().is_cpu();
    const std::vector<PipelineChoice> builders = device_builders(session);
    std::vector<PipelineChoice> few = stress_pipelines(session, true, other_forms);
    Systems ordinary, not_finite, repeated, large;
    add_systems(ordinary, builders_in_formats(quick), judge_builder);
    add_systems(ordinary, quick ? few : stress_pipelines(session, false, other_forms),
                judge_pipeline);
    add_libraries(ordinary, quick);

    not_finite.push_back({"loading", Kind::host, "", judge_loading});
    add_libraries(not_finite, quick);

    std::erase_if(few, is_library);
    add_systems(repeated, builders, judge_builder);
    add_systems(repeated, few, judge_pipeline);

    // Left out: brute, since it is the sweep that computes the expected pairs; other kernel forms; other box formats.
    std::erase_if(few, [](const PipelineChoice& one) {
        return one.collider.name == "brute" || one.collider.form != KernelForm::of_device ||
               one.builder.boxes != "f32";
    });
    add_systems(large, builders, judge_large_build);
    add_systems(large, few, judge_large_query);

    std::vector<StressPart> parts;
    std::vector<StressFamily> families = {hard_family};
    families.insert(families.end(), stress_families().begin(), stress_families().end());
    for (const StressFamily& family : families)
        for (const StressCase& one : family.cases(size))
            parts.push_back({std::string(family.name), one,
                             one.is_large                  ? large
                             : family.name == "not-finite" ? not_finite
                                                           : ordinary});
    const auto spheres = [size](uint triangles) {
        return [=] { return crossed_spheres(triangles, size.seed); };
    };
    parts.push_back(
        {"layout",
         {"to 2^31 leaves", [] { return StressScene(); }},
         {{"layout.h", Kind::host, "", [size](auto&) { return judge_layout_formulas(size); }}}});
    const uint triangles = quick ? 500 : 5000;
    parts.push_back({"group-sizes",
                     {std::to_string(triangles) + " triangles", spheres(triangles)},
                     group_size_systems(session, quick)});
    const int repeats = quick ? 20 : 1000;
    parts.push_back(
        {"repeats", {std::to_string(repeats) + " times", spheres(1000)}, repeated, repeats});
    return parts;
}

}  // namespace bvhbench
