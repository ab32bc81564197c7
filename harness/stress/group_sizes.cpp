// SPDX-License-Identifier: MIT
//
// No parameter may change an answer. Every group-size parameter is tried with all values that the parameter and the device
// allow, each in a new session over the first pipeline that reads the parameter.
#include <algorithm>
#include <memory>
#include <set>

#include "harness/session/tuning_file.h"
#include "harness/stress/run.h"

namespace bvhbench {
namespace {

/// A pipeline, or a builder alone, and the parameters that it read when it was first tried.
struct Asker {
    PipelineChoice pipeline;
    std::optional<std::set<const Parameter*>> asked = {};
};

/// Returns pipelines that read group-size parameters, fastest to compile first.
std::vector<Asker> askers()
{
    const BuilderChoice builders[] = {{.name = "oibvh-multi"},
                                      {.name = "oibvh-single"},
                                      {{.sorted_leaves = true}, "oibvh-multi"},
                                      {{.order = "kd"}, "oibvh-multi"},
                                      {.name = "apetrei"},
                                      {.name = "apetrei-fused"},
                                      {.name = "karras"},
                                      {.name = "lbvh-levels"},
                                      {.name = "hploc"},
                                      {.name = "oibvh-wide4"}};
    std::vector<Asker> all;
    for (const BuilderChoice& builder : builders)
        all.push_back({{builder, {}}});
    for (const KernelForm form : {KernelForm::groups, KernelForm::chunks})
        for (const char* name : {"leaf", "group", "block", "bvtt", "front", "front-leaf", "grid",
                                 "all-pairs", "sort-sweep"})
            all.push_back({{builders[0], {{.form = form}, name}}});
    all.push_back({{builders[0], {.name = "leaf", .narrow = "exact"}}});
    return all;
}

/// Judges an asker with the values of `tuning` in a new session. Throws what the builder or pipeline throws.
Findings tried(SceneUnderStress& scene, Asker& asker, const Tuning& tuning)
{
    Device device = scene.session.device();
    device.tuning = tuning;
    Session own(std::move(device), scene.session.scenes());
    Findings findings;
    if (is_builder(asker.pipeline)) {
        const Mesh& mesh = scene.scene().mesh;
        const Input input = upload(own.device(), own.queue(), mesh.points, mesh.faces);
        const BuilderChoice& builder = asker.pipeline.builder;
        const HostTree tree = built_tree(own, builder, input).to_host_tree();
        Oracle oracle(own, input);
        const Check check = check_tree(tree, input, builder, oracle);
        const bool is_wrong = check.verdict == Check::Verdict::differs;
        findings = judge_tree(tree, mesh.points, mesh.faces);
        findings[Invariant::layout] = {
            is_wrong ? Finding::Verdict::broken : Finding::Verdict::holds, 1, 0, 0, check.detail};
    } else {
        const StressQuestion& question = scene.question();
        findings =
            judge_finder(finder_of(own, asker.pipeline), {question.scene, question.expected, {}});
    }
    if (!asker.asked)
        asker.asked = own.device().tuning.asked();
    return findings;
}

/// Returns the first asker that reads a parameter, null if none does on this kind of device. Tries those before it with default
/// values, unless they were tried for another parameter, and adds their findings to `findings`.
Asker* asker_of(const Parameter& parameter, std::vector<Asker>& all, SceneUnderStress& scene,
                Findings& findings)
{
    for (Asker& one : all) {
        if (!one.asked)
            join(findings, tried(scene, one, {}));
        if (one.asked->contains(&parameter))
            return &one;
    }
    return nullptr;
}

/// Returns the findings of `judge` for each power of two from `least` to `most`, or with `few` for the first and last, with the
/// value in their text.
template <class JudgeAt>
Findings judged_values(uint least, uint most, bool few, const JudgeAt& judge)
{
    Findings findings;
    for (uint value = least; value <= most; value *= 2)
        if (!few || value == least || value > most / 2)
            join(findings, with_words("at " + std::to_string(value), judge(value)));
    return findings;
}

}  // namespace

std::vector<StressSystem> group_size_systems(Session& session, bool few)
{
    std::vector<StressSystem> systems;
    const auto add = [&](std::string name, const auto& judge) {
        systems.push_back({std::move(name), StressCell::Kind::builder, "", judge});
    };
    const auto all = std::make_shared<std::vector<Asker>>(askers());
    for (const Parameter* parameter : tuning_parameters()) {
        if (!parameter->is_group_size)
            continue;
        add(std::string(parameter->name), [=](SceneUnderStress& scene) -> std::optional<Findings> {
            Findings findings;
            Asker* const asker = asker_of(*parameter, *all, scene, findings);
            if (asker == nullptr)
                return {};
            const auto judge = [&](uint value) {
                Tuning tuning("stress");
                tuning.set(*parameter, value);
                return tried(scene, *asker, tuning);
            };
            // `findings_of` turns an unsupported group size, or too little local memory, into a refusal.
            const uint least = std::max(1u, parameter->least);
            join(findings, judged_values(least, parameter->most, few, [&](uint value) {
                     return findings_of(scene.session, true, [&] { return judge(value); });
                 }));
            return findings;
        });
    }
    // The builders' option applies to grouped kernels on every device.
    for (const PipelineChoice& one : device_builders(session))
        add(one.builder.name + " --group-size",
            [few, builder = one.builder](SceneUnderStress& scene) {
                return judged_values(1, 1024, few, [&](uint value) {
                    BuilderChoice sized = builder;
                    sized.group_size = value;
                    return judge_builder(scene, {sized, {}});
                });
            });
    return systems;
}

}  // namespace bvhbench
