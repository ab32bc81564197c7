// SPDX-License-Identifier: MIT
#include <future>

#include "builders/host_tree.h"
#include "geometry/bits.h"
#include "harness/base/failure.h"
#include "harness/measure/engine.h"
#include "harness/stress/run.h"
#include "oibvh/layout.h"
#include "oibvh/layout_check.h"
#include "scenes/generate/random.h"

namespace bvhbench {
namespace {

using enum Finding::Verdict;

/// Judges the launches of a build. The limit allows for sort passes over 63-bit codes and a few launches per level.
Finding judge_launches(const std::vector<StageTime>& stages, uint triangles)
{
    int launches = 0;
    for (const StageTime& stage : stages)
        launches += stage.launches;
    if (launches <= 100 + 8 * static_cast<int>(ceil_log2(triangles)))
        return {holds, 1};
    return {broken, 1, 1, 0, "it took " + std::to_string(launches) + " launches"};
}

/// Judges the number of nodes, which Eq. (7) gives for builders with the paper's layout, and the predicted memory.
Finding judge_layout(const BuilderEntry& entry, const Tree& tree, const Builder& builder,
                     uint triangles)
{
    const std::size_t nodes = tree.node_count();
    const bool has_paper_layout = entry.oracle == "oibvh-reference" && entry.name != "perfect";
    if (const std::size_t right = oi_node_count(oi_shape(triangles));
        has_paper_layout && nodes != right)
        return {broken, nodes, 0, 0,
                "it stores " + std::to_string(nodes) + " nodes, and Eq. (7) says " +
                    std::to_string(right)};
    if (builder.footprint(triangles) != builder.reserved())
        return {broken, nodes, 0, 0, "it reserves other memory than it predicts"};
    return {holds, nodes};
}

/// Builds once. Returns findings about launches and layout, and the tree, whose leaves and boxes are not judged yet.
std::pair<Findings, HostTree> built_once(Session& session, Builder& builder,
                                         const BuilderEntry& entry, const Input& input)
{
    const uint triangles = input.triangle_count();
    builder.reserve(triangles);
    const Tree* tree = nullptr;
    const auto stages = session.build_once(builder, input, Start::from_triangles, &tree);
    return {{{Invariant::ends, judge_launches(stages, triangles)},
             {Invariant::layout, judge_layout(entry, *tree, builder, triangles)}},
            tree->to_host_tree()};
}

/// Builds once, then repeatedly, and returns the findings.
Findings judge_builds(SceneUnderStress& scene, const BuilderChoice& choice)
{
    const Input& input = scene.input();
    Builder& builder = scene.session.builder(choice);
    auto [built, tree] = built_once(scene.session, builder, find_builder(choice.name), input);
    Findings findings = judge_tree(tree, input.points, input.faces);
    const Check check = check_tree(tree, input, choice, scene.oracle());
    if (check.verdict == Check::Verdict::differs && !is_any_broken(findings))
        built[Invariant::layout] = {broken, built[Invariant::layout].checked, 0, 0, check.detail};
    findings.merge(built);
    findings[Invariant::same] = judge_repeats(scene.repeats, [&] {
        const Tree* again = nullptr;
        scene.session.build_once(builder, input, Start::from_triangles, &again);
        return tree_hash(again->to_host_tree()) == check.tree_hash;
    });
    return findings;
}

}  // namespace

Findings findings_of(Session& session, bool may_refuse, const std::function<Findings()>& judge)
{
    Findings findings;
    Measurement measurement;
    int order = 0;
    Engine(session, {}, order).prepare(measurement, [&] { findings = judge(); });
    const Cell& cell = measurement.cell;
    if (cell.status == Cell::Status::measured)
        findings.try_emplace(Invariant::ends, Finding{holds, 1});
    else if (may_refuse || cell.status == Cell::Status::skipped)
        findings = {{Invariant::ends, {refused, 1, 0, 0, cell.reason}}};
    else
        findings = {{Invariant::ends, {broken, 1, 1, 0, cell.reason}}};
    return findings;
}

std::vector<PipelineChoice> device_builders(Session& session)
{
    std::vector<PipelineChoice> builders;
    for (const BuilderEntry& entry : builder_catalog())
        reason_of_failure([&] {  // judge_builder reports why a builder cannot be made
            if (entry.make != nullptr &&
                entry.make(session.programs(), {})->card().runs == BuilderCard::Runs::on_device)
                builders.push_back({{.name = std::string(entry.name)}, {}});
        });
    return builders;
}

Findings judge_builder(SceneUnderStress& scene, const PipelineChoice& alone)
{
    const BuilderChoice& choice = alone.builder;
    const Input& input = scene.input();
    std::string wrong;
    // A group size that was asked for may be unsupported, or need too much local memory.
    Findings findings = findings_of(scene.session, choice.group_size != 0, [&]() -> Findings {
        bool is_refused = false;
        wrong = contract_violation(scene.session, choice, input, scene.oracle(), &is_refused);
        if (!is_refused)
            return judge_builds(scene, choice);
        const std::string why(find_builder(choice.name).may_refuse);
        return {{Invariant::ends, {refused, 1, 0, 0, why}}};
    });
    if (!wrong.empty() && !is_any_broken(findings))  // second build, sorted leaves or refit
        findings[Invariant::same] = {broken, 1, 1, 0, wrong};
    return findings;
}

Findings judge_large_build(SceneUnderStress& scene, const PipelineChoice& alone)
{
    const Input& input = scene.input();
    return findings_of(scene.session, false, [&] {
        const BuilderEntry& entry = find_builder(alone.builder.name);
        const auto builder = make_builder(alone.builder, scene.session.programs());
        auto [findings, tree] = built_once(scene.session, *builder, entry, input);
        const auto hash =
            std::async(std::launch::async, [&tree] { return tree_hash(tree); }).share();
        join(findings, judge_tree(tree, input.points, input.faces));
        if (!entry.oracle.empty() &&
            scene.hashes.try_emplace(entry.oracle, hash.get()).first->second != hash.get())
            findings[Invariant::layout] = {
                broken, 1, 0, 0,
                "it is another tree than another builder's, which must leave the same"};
        return findings;
    });
}

Findings judge_layout_formulas(const StressSize& size)
{
    Finding finding;
    const auto look_at = [&](uint leaves) {
        const std::string wrong = layout_violation(leaves);
        join(finding, wrong.empty() ? Finding{holds, 1} : Finding{broken, 1, 1, 0, wrong});
    };
    const uint count = size.quick ? 10000 : 1000000;
    for (uint leaves = 1; leaves <= count; ++leaves)
        look_at(leaves);
    for (uint k = 13; k <= 31; ++k)
        for (const uint leaves : {(1u << k) - 1, 1u << k, (1u << k) + 1})
            if (leaves <= 1u << 31)
                look_at(leaves);
    Random random(size.seed);
    for (uint k = 0; k < count; ++k)
        look_at(1 + static_cast<uint>(random.bits() % (1u << 31)));
    return {{Invariant::layout, finding}};
}

}  // namespace bvhbench
