// SPDX-License-Identifier: MIT
#include <memory>

#include "builders/spell_out.h"
#include "geometry/bits.h"
#include "geometry/error.h"
#include "geometry/hash.h"
#include "harness/base/failure.h"
#include "harness/judge/contract.h"
#include "harness/stress/systems.h"
#include "oibvh/layout.h"

namespace bvhbench {
namespace {

using enum Finding::Verdict;

/// Launches that a build takes at most: passes of sorts over codes of 63 bits, and a few a level.
int most_launches(uint triangles) { return 100 + 8 * static_cast<int>(ceil_log2(triangles)); }

int launches_of(const std::vector<StageTime>& stages)
{
    int launches = 0;
    for (const StageTime& stage : stages)
        launches += stage.launches;
    return launches;
}

Finding judge_launches(int launches, uint triangles)
{
    Finding finding{holds, 1};
    if (launches > most_launches(triangles))
        finding = {broken, 1, 1, 0, "it took " + std::to_string(launches) + " launches"};
    return finding;
}

/// Whether its nodes lie as the paper's layout says: Eq. (7) counts them.
bool has_the_papers_layout(const BuilderEntry& entry)
{
    return entry.oracle == "oibvh-reference" && entry.name != "perfect";
}

Finding judge_layout(const BuilderEntry& entry, const Tree& tree, const Builder& builder,
                     uint triangles)
{
    Finding finding{holds, tree.node_count()};
    if (builder.footprint(triangles) != builder.reserved())
        finding = {broken, finding.checked, 0, 0, "it reserves other memory than it predicts"};
    if (has_the_papers_layout(entry) && tree.node_count() != oi_node_count(oi_shape(triangles)))
        finding = {broken, finding.checked, 0, 0,
                   "it stores " + std::to_string(tree.node_count()) + " nodes, and Eq. (7) says " +
                       std::to_string(oi_node_count(oi_shape(triangles)))};
    return finding;
}

/// One build, and which invariant it breaks, if it does.
Findings judge_one_build(Session& session, const BuilderChoice& choice, const Input& input,
                         Oracle& oracle)
{
    Builder& builder = session.builder(choice);
    builder.reserve(input.triangle_count());
    const Tree* tree = nullptr;
    const auto stages = session.build_once(builder, input, Start::from_triangles, &tree);
    const HostTree spelled_out = tree->spelled_out();
    Findings findings = judge_tree(spelled_out, input.points, input.faces);
    findings[Invariant::ends] = judge_launches(launches_of(stages), input.triangle_count());
    findings[Invariant::layout] =
        judge_layout(find_builder(choice.name), *tree, builder, input.triangle_count());
    const Check check = check_tree(spelled_out, input, choice, oracle);
    const bool is_wrong_tree = check.verdict == Check::Verdict::differs &&
                               findings[Invariant::leaves].verdict == holds &&
                               findings[Invariant::boxes].verdict == holds;
    if (is_wrong_tree)
        findings[Invariant::layout] = {broken, tree->node_count(), 0, 0, check.detail};
    return findings;
}

Finding judge_builds(Session& session, const BuilderChoice& choice, const Input& input, int repeats)
{
    Builder& builder = session.builder(choice);
    builder.reserve(input.triangle_count());
    std::vector<std::uint64_t> hashes;
    for (int repeat = 0; repeat <= repeats; ++repeat) {
        const Tree* tree = nullptr;
        session.build_once(builder, input, Start::from_triangles, &tree);
        hashes.push_back(tree_hash(tree->spelled_out()));
    }
    return judge_repeats(hashes);
}

}  // namespace

std::string system_name(const BuilderChoice& builder)
{
    return builder.name + (builder.boxes == "f32" ? "" : " in " + builder.boxes);
}

bool builds_on_device(Session& session, const BuilderEntry& entry)
{
    bool on_device = false;  // of one that cannot be made, judge_builder says why
    reason_of_failure([&] {
        on_device = entry.make != nullptr &&
                    entry.make(session.programs(), {})->card().runs == BuilderCard::Runs::on_device;
    });
    return on_device;
}

Findings judge_builder(Session& session, const BuilderChoice& choice, const Input& input,
                       Oracle& oracle, int repeats)
{
    Findings findings;
    const BuilderEntry& entry = find_builder(choice.name);
    bool refused = false;
    std::string wrong;
    bool cannot_be = false;
    const std::string failure = reason_of_failure(cannot_be, [&] {
        wrong = broken_contract(session, choice, input, oracle, &refused);
        if (refused)
            return;
        findings = judge_one_build(session, choice, input, oracle);
        findings[Invariant::same] = judge_builds(session, choice, input, repeats);
    });
    if (refused)
        return {
            {Invariant::ends, {Finding::Verdict::refused, 1, 0, 0, std::string(entry.may_refuse)}}};
    if (!failure.empty()) {
        session.renew_queue();
        if (cannot_be)
            return {{Invariant::ends, {Finding::Verdict::refused, 1, 0, 0, failure}}};
        return {{Invariant::ends, {broken, 1, 1, 0, failure}}};
    }
    bool is_told = wrong.empty();
    for (const auto& [invariant, finding] : findings)
        is_told = is_told || finding.verdict == broken;
    if (!is_told)  // of the second build, of sorted leaves, of a refit
        findings[Invariant::same] = {broken, 1, 1, 0, wrong};
    return findings;
}

LateFindings build_large(Session& session, const BuilderChoice& choice, const Input& input)
{
    const BuilderEntry& entry = find_builder(choice.name);
    LateFindings late;
    auto spelled_out = std::make_shared<HostTree>();
    const std::string failure = reason_of_failure([&] {
        const auto builder = make_builder(choice, session.programs());
        builder->reserve(input.triangle_count());
        const Tree* tree = nullptr;
        const auto stages = session.build_once(*builder, input, Start::from_triangles, &tree);
        late.so_far[Invariant::ends] = judge_launches(launches_of(stages), input.triangle_count());
        late.so_far[Invariant::layout] =
            judge_layout(entry, *tree, *builder, input.triangle_count());
        *spelled_out = tree->spelled_out();
    });
    if (!failure.empty()) {
        session.renew_queue();
        late.so_far = {{Invariant::ends, {broken, 1, 1, 0, failure}}};
        late.check = [] { return LateFindings::Tree{}; };
        return late;
    }
    late.check = [spelled_out, points = input.points, faces = input.faces] {
        return LateFindings::Tree{judge_tree(*spelled_out, points, faces), tree_hash(*spelled_out)};
    };
    return late;
}

}  // namespace bvhbench
