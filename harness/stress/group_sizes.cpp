// SPDX-License-Identifier: MIT
//
// No parameter may change an answer. Those that are sizes of groups are tried with every value that they and the device
// allow, each in a session of its own over the pipeline that asks for it.
#include <algorithm>
#include <set>

#include "baselines/parameters.h"
#include "builders/parameters.h"
#include "collide/parameters.h"
#include "geometry/error.h"
#include "harness/base/failure.h"
#include "harness/stress/parts.h"

namespace bvhbench {
namespace {

/// What can ask for a group size, from what takes the least to compile on.
struct Asker {
    BuilderChoice builder;
    ColliderChoice collider;  ///< of an empty name: the builder alone
};

std::vector<Asker> askers()
{
    std::vector<Asker> all = {{{.name = "oibvh-multi"}, {}},
                              {{.name = "oibvh-single"}, {}},
                              {{.name = "oibvh-multi", .sorted_leaves = true}, {}},
                              {{.name = "oibvh-multi", .order = "kd"}, {}},
                              {{.name = "apetrei"}, {}},
                              {{.name = "apetrei-fused"}, {}},
                              {{.name = "karras"}, {}},
                              {{.name = "lbvh-levels"}, {}},
                              {{.name = "oibvh-wide4"}, {}}};
    for (const KernelForm form : {KernelForm::groups, KernelForm::chunks})
        for (const char* name : {"leaf", "group", "block", "bvtt", "front", "grid"}) {
            ColliderChoice collider;
            collider.name = name;
            collider.form = form;
            all.push_back({{.name = "oibvh-multi"}, collider});
        }
    ColliderChoice exact;
    exact.name = "leaf";
    exact.narrow = "exact";
    all.push_back({{.name = "oibvh-multi"}, exact});
    return all;
}

std::vector<const Parameter*> group_sizes()
{
    std::vector<const Parameter*> all;
    const auto add = [&](const auto& parameters) {
        for (const Parameter* parameter : parameters)
            if (parameter->values == ValueIs::group_size)
                all.push_back(parameter);
    };
    add(builder_parameters);
    add(baseline_parameters);
    add(collider_parameters);
    return all;
}

class Trial {
public:
    Trial(Session& session, const StressQuestion& question, const Asker& asker,
          const Tuning& tuning)
        : session_(tuned(session.device(), tuning), session.scenes())
        , question_(question)
        , asker_(asker)
    {}

    /// Throws what the builder or pipeline throws.
    Findings run()
    {
        const Mesh& mesh = question_.scene.mesh;
        if (!asker_.collider.name.empty())
            return judge_finder(finder_of(session_, {asker_.builder, asker_.collider, false}),
                                {question_.scene, question_.expected, {}}, 0);
        const Input input = upload(session_.device(), session_.queue(), mesh.points, mesh.faces);
        Builder& builder = session_.builder(asker_.builder);
        builder.reserve(input.triangle_count());
        const Tree* tree = nullptr;
        session_.build_once(builder, input, Start::from_triangles, &tree);
        Oracle oracle(session_, input);
        Findings findings = judge_tree(tree->spelled_out(), mesh.points, mesh.faces);
        const Check check = check_tree(tree->spelled_out(), input, asker_.builder, oracle);
        findings[Invariant::layout] = {check.verdict == Check::Verdict::differs
                                           ? Finding::Verdict::broken
                                           : Finding::Verdict::holds,
                                       1, 0, 0, check.detail};
        return findings;
    }

    bool asks_for(const Parameter& parameter) const
    {
        return session_.device().tuning.asked().contains(&parameter);
    }

private:
    static Device tuned(Device device, const Tuning& tuning)
    {
        device.tuning = tuning;
        return device;
    }

    Session session_;
    const StressQuestion& question_;
    Asker asker_;
};

/// All powers of two from the least to the most; if few, the ends and one between.
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

Findings over_value(Session& session, const StressQuestion& question, const Asker& asker,
                    const Parameter& parameter, uint value)
{
    Findings findings;
    const std::string failure = reason_of_failure([&] {
        Tuning tuning("stress");
        tuning.set(parameter, value);
        findings = Trial(session, question, asker, tuning).run();
        findings[Invariant::ends] = {Finding::Verdict::holds, 1};
    });
    if (!failure
             .empty())  // the device has no such groups, or not the local memory for them: one sentence
        return {{Invariant::ends, {Finding::Verdict::refused, 1, 0, 0, failure}}};
    return findings;
}

/// The same sizes as a builder's own option, in which kernels in groups are had on every device.
void stress_option(Session& session, const StressTask& task, const StressScene& scene,
                   StressCell cell, const AddStressCell& add)
{
    const Input input =
        upload(session.device(), session.queue(), scene.mesh.points, scene.mesh.faces);
    Oracle oracle(session, input);
    const Parameter any{.name = "--group-size",
                        .meaning = "",
                        .stage = "",
                        .least = 1,
                        .most = 1024,
                        .values = ValueIs::group_size,
                        .candidates = {}};
    for (const BuilderEntry& entry : builder_catalog()) {
        cell.system = std::string(entry.name) + ' ' + std::string(any.name);
        if (!builds_on_device(session, entry) || !task.wants(cell))
            continue;
        StressCell done = cell;
        for (const uint value : values_of(any, task.size.quick)) {
            join(done.findings,
                 with_words(
                     "at " + std::to_string(value),
                     judge_builder(session, {.name = std::string(entry.name), .group_size = value},
                                   input, oracle, 0)));
        }
        add(std::move(done));
    }
}

}  // namespace

void stress_group_sizes(Session& session, const StressTask& task, const AddStressCell& add)
{
    const uint triangles = task.size.quick ? 500 : 5000;
    std::optional<StressQuestion> question;
    std::vector<std::pair<Asker, std::set<const Parameter*>>> asked;
    for (const Parameter* parameter : group_sizes()) {
        StressCell cell;
        cell.family = "group-sizes";
        cell.scene = std::to_string(triangles) + " triangles";
        cell.system = parameter->name;
        cell.triangles = triangles;
        if (!task.wants(cell))
            continue;
        if (!question)
            question = question_of(crossed_spheres(triangles, task.size.seed), task.size.seed);
        const auto found = std::find_if(asked.begin(), asked.end(), [&](const auto& one) {
            return one.second.contains(parameter);
        });
        std::optional<Asker> asker;
        if (found != asked.end())
            asker = found->first;
        for (std::size_t next = asked.size(); !asker && next < askers().size(); ++next) {
            Trial trial(session, *question, askers()[next], {});
            join(cell.findings, trial.run());
            std::set<const Parameter*> wants;
            for (const Parameter* each : group_sizes())
                if (trial.asks_for(*each))
                    wants.insert(each);
            asked.emplace_back(askers()[next], wants);
            if (wants.contains(parameter))
                asker = askers()[next];
        }
        if (!asker)
            continue;  // nobody asks for it on this kind of device
        for (const uint value : values_of(*parameter, task.size.quick)) {
            join(cell.findings,
                 with_words("at " + std::to_string(value),
                            over_value(session, *question, *asker, *parameter, value)));
        }
        add(std::move(cell));
    }
    StressCell cell;
    cell.family = "group-sizes";
    cell.scene = std::to_string(triangles) + " triangles";
    cell.triangles = triangles;
    stress_option(session, task, crossed_spheres(triangles, task.size.seed), std::move(cell), add);
}

}  // namespace bvhbench
