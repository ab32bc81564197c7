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

/// Returns pipelines that read group-size parameters, fastest to compile first; without a collider's name, the builder alone.
std::vector<StressPipeline> askers()
{
    std::vector<StressPipeline> all = {{{.name = "oibvh-multi"}, {}},
                                       {{.name = "oibvh-single"}, {}},
                                       {{.name = "oibvh-multi", .sorted_leaves = true}, {}},
                                       {{.name = "oibvh-multi", .order = "kd"}, {}},
                                       {{.name = "apetrei"}, {}},
                                       {{.name = "apetrei-fused"}, {}},
                                       {{.name = "karras"}, {}},
                                       {{.name = "lbvh-levels"}, {}},
                                       {{.name = "oibvh-wide4"}, {}}};
    for (const KernelForm form : {KernelForm::groups, KernelForm::chunks})
        for (const char* name : {"leaf", "group", "block", "bvtt", "front", "grid"})
            all.push_back({{.name = "oibvh-multi"}, {.name = name, .form = form}});
    all.push_back({{.name = "oibvh-multi"}, {.name = "leaf", .narrow = "exact"}});
    return all;
}

struct Tried {
    Findings findings;
    std::set<const Parameter*> asked;  ///< parameters whose value was read
};

/// Judges one pipeline with the values of `tuning` in a new session. Throws what the builder or pipeline throws.
Tried tried(Session& session, SceneUnderStress& scene, const StressPipeline& asker,
            const Tuning& tuning)
{
    Device device = session.device();
    device.tuning = tuning;
    Session own(std::move(device), session.scenes());
    Findings findings;
    if (!asker.collider.name.empty()) {
        const StressQuestion& question = scene.question();
        findings = judge_finder(finder_of(own, asker), {question.scene, question.expected, {}});
    } else {
        const Mesh& mesh = scene.scene().mesh;
        const Input input = upload(own.device(), own.queue(), mesh.points, mesh.faces);
        const HostTree tree = built_tree(own, asker.builder, input).spelled_out();
        Oracle oracle(own, input);
        const Check check = check_tree(tree, input, asker.builder, oracle);
        const bool is_wrong = check.verdict == Check::Verdict::differs;
        findings = judge_tree(tree, mesh.points, mesh.faces);
        findings[Invariant::layout] = {
            is_wrong ? Finding::Verdict::broken : Finding::Verdict::holds, 1, 0, 0, check.detail};
    }
    return {std::move(findings), own.device().tuning.asked()};
}

/// Finds the pipeline that reads a parameter: tries the pipelines with default values, in order, until one reads it.
class Askers {
public:
    explicit Askers(Session& session) : session_(session) {}

    /// Returns null if none reads it on this kind of device. Adds the findings of the pipelines it tries to `findings`.
    const StressPipeline* of(const Parameter& parameter, SceneUnderStress& scene,
                             Findings& findings)
    {
        for (std::size_t k = 0; k < all_.size(); ++k) {
            if (k == asked_.size()) {
                Tried one = tried(session_, scene, all_[k], {});
                join(findings, one.findings);
                asked_.push_back(std::move(one.asked));
            }
            if (asked_[k].contains(&parameter))
                return &all_[k];
        }
        return nullptr;
    }

private:
    Session& session_;
    const std::vector<StressPipeline> all_ = askers();
    std::vector<std::set<const Parameter*>> asked_;  ///< of each pipeline tried so far
};

/// Returns all accepted powers of two from the least to the most; with `few`, only the first and last.
std::vector<uint> values_of(const Parameter& parameter, bool few)
{
    std::vector<uint> values;
    for (uint value = std::max(1u, parameter.least); value <= parameter.most; value *= 2)
        if (parameter.refusal(value).empty())
            values.push_back(value);
    if (few && values.size() > 2)
        values = {values.front(), values.back()};
    return values;
}

/// Returns the findings of `judge` for each value, with the value in their text.
template <class JudgeAt>
Findings judged_values(const Parameter& parameter, bool few, const JudgeAt& judge)
{
    Findings findings;
    for (const uint value : values_of(parameter, few))
        join(findings, with_words("at " + std::to_string(value), judge(value)));
    return findings;
}

/// The builders' option --group-size, which applies to grouped kernels on every device.
constexpr Parameter builder_option{.name = "--group-size",
                                   .meaning = "",
                                   .stage = "",
                                   .least = 1,
                                   .most = 1024,
                                   .is_group_size = true,
                                   .candidates = {}};

}  // namespace

std::vector<StressSystem> group_size_systems(Session& session, bool few)
{
    std::vector<StressSystem> systems;
    const auto add = [&](std::string name, const auto& judge) {
        systems.push_back(stress_system(std::move(name), StressCell::Kind::builder, "", judge));
    };
    const auto askers = std::make_shared<Askers>(session);
    for (const Parameter* parameter : tuning_parameters()) {
        if (!parameter->is_group_size)
            continue;
        add(std::string(parameter->name),
            [&session, askers, parameter, few](SceneUnderStress& scene) -> std::optional<Findings> {
                Findings findings;
                const StressPipeline* asker = askers->of(*parameter, scene, findings);
                if (asker == nullptr)
                    return {};
                // `settled` turns an unsupported group size, or too little local memory, into a refusal.
                join(findings, judged_values(*parameter, few, [&](uint value) {
                         return settled(session, true, [&] {
                             Tuning tuning("stress");
                             tuning.set(*parameter, value);
                             return tried(session, scene, *asker, tuning).findings;
                         });
                     }));
                return findings;
            });
    }
    for (const BuilderChoice& builder : device_builders(session))
        add(builder.name + " --group-size", [&session, builder, few](SceneUnderStress& scene) {
            return judged_values(builder_option, few, [&](uint value) {
                BuilderChoice sized = builder;
                sized.group_size = value;
                return judge_builder(session, sized, scene, 0);
            });
        });
    return systems;
}

}  // namespace bvhbench
