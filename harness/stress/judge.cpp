// SPDX-License-Identifier: MIT
#include "harness/stress/judge.h"

#include <algorithm>
#include <iterator>

#include "builders/spell_out.h"
#include "collide/oracles/exact_reference.h"
#include "collide/oracles/sweep.h"
#include "geometry/hash.h"

namespace bvhbench {
namespace {

using enum Finding::Verdict;

std::size_t missing_from(const PairList& list, const PairList& other)
{
    std::vector<Pair> missing;
    std::set_difference(other.pairs().begin(), other.pairs().end(), list.pairs().begin(),
                        list.pairs().end(), std::back_inserter(missing));
    return missing.size();
}

PairList pairs_of(const StressScene& scene)
{
    return touching_pairs(scene.mesh.points, scene.mesh.faces, true);
}

FoundPairs expected_over(const StressScene& scene, PairList pairs)
{
    FoundPairs expected;
    expected.pairs = std::move(pairs);
    if (has_exact_reference)
        expected.contacts =
            intersecting_pairs(scene.mesh.points, scene.mesh.faces, *expected.pairs, true);
    return expected;
}

FoundPairs in_original_numbers(FoundPairs found, const StressVariant& variant)
{
    for (auto* list : {&found.pairs, &found.contacts})
        if (*list)
            *list = in_original_numbers(**list, variant);
    return found;
}

/// What is asked of the system at all, and known.
template <class Add>
void compare(const FoundPairs& found, const FoundPairs& expected, const Add& add)
{
    if (found.pairs && expected.pairs)
        add(Invariant::pairs, found.is_rounded ? judge_candidates(*found.pairs, *expected.pairs)
                                               : judge_pairs(*found.pairs, *expected.pairs));
    if (found.contacts && expected.contacts)
        add(Invariant::contacts, judge_pairs(*found.contacts, *expected.contacts));
}

}  // namespace

std::uint64_t hash_of(const FoundPairs& found)
{
    Hash hash;
    for (const auto* list : {&found.pairs, &found.contacts})
        if (*list)
            hash.value((*list)->hash());
    return hash.get();
}

Findings judge_tree(const HostTree& tree, std::span<const Point> points,
                    std::span<const Face> faces)
{
    const Breach breach = first_breach(tree, points, faces);
    Findings findings = {{Invariant::leaves, {holds, faces.size()}},
                         {Invariant::boxes, {holds, tree.nodes.size()}}};
    if (breach.of != Breach::Of::nothing) {
        Finding& of =
            findings[breach.of == Breach::Of::leaves ? Invariant::leaves : Invariant::boxes];
        of.verdict = broken;
        of.detail = breach.sentence;
    }
    return findings;
}

Finding judge_pairs(const PairList& found, const PairList& expected)
{
    const std::size_t missed = missing_from(found, expected);
    const std::size_t extra = missing_from(expected, found);
    Finding finding{holds, expected.size(), missed + extra + found.surplus(), missed};
    if (finding.wrong > 0) {
        finding.verdict = broken;
        finding.detail = std::to_string(missed) + " missed, " + std::to_string(extra) + " false, " +
                         std::to_string(found.surplus()) + " twice, of " +
                         std::to_string(expected.size());
    }
    return finding;
}

Finding judge_candidates(const PairList& found, const PairList& expected)
{
    const std::size_t missed = missing_from(found, expected);
    Finding finding{holds, expected.size(), missed + found.surplus(), missed};
    if (finding.wrong > 0) {
        finding.verdict = broken;
        finding.detail = std::to_string(missed) + " missed, " + std::to_string(found.surplus()) +
                         " twice, of " + std::to_string(expected.size());
    }
    return finding;
}

Finding judge_repeats(std::span<const std::uint64_t> hashes)
{
    Finding finding{holds, hashes.size()};
    for (const std::uint64_t hash : hashes)
        finding.wrong += hash != hashes.front() ? 1 : 0;
    if (finding.wrong > 0) {
        finding.verdict = broken;
        finding.detail = std::to_string(finding.wrong) + " of " + std::to_string(hashes.size()) +
                         " runs left something else than the first";
    }
    return finding;
}

StressQuestion question_of(StressScene scene, std::uint64_t seed)
{
    StressQuestion question{std::move(scene), {}, {}};
    question.expected = expected_over(question.scene, pairs_of(question.scene));
    const auto add = [&](std::optional<StressVariant> variant) {
        if (variant)
            question.variants.push_back({std::move(*variant), question.expected});
    };
    add(shuffled(question.scene, seed));
    add(swapped(question.scene));
    add(scaled(question.scene, seed));
    // With as many bits as a translation takes, a scene with an outlier is all but one point: another one.
    const std::size_t most =
        100 * (question.expected.pairs->size() + question.scene.mesh.faces.size());
    if (auto translation = translated(question.scene))
        if (PairList pairs = pairs_of(translation->snapped); pairs.size() <= most)
            question.variants.push_back({std::move(translation->moved),
                                         expected_over(translation->snapped, std::move(pairs))});
    return question;
}

StressQuestion without_adjacent(const StressQuestion& question)
{
    StressQuestion apart = question;
    const auto leave_out = [&faces = question.scene.mesh.faces](FoundPairs& found) {
        for (auto* list : {&found.pairs, &found.contacts})
            if (*list)
                *list = selected(**list, {faces, {}}, Relation::apart);
    };
    leave_out(apart.expected);
    for (StressQuestion::Variant& variant : apart.variants)
        leave_out(variant.expected);
    return apart;
}

Findings judge_finder(const PairFinder& finder, const StressQuestion& question, int repeats)
{
    Findings findings;
    const FoundPairs found = finder(question.scene, 0);
    compare(found, question.expected,
            [&](Invariant invariant, const Finding& finding) { findings[invariant] = finding; });

    const auto add_to = [&](Invariant invariant, std::string_view words) {
        return [&findings, invariant, words](Invariant, const Finding& finding) {
            join(findings, with_words(words, {{invariant, finding}}));
        };
    };
    for (const auto& [variant, expected] : question.variants)
        compare(in_original_numbers(finder(variant.scene, 0), variant), expected,
                add_to(variant.of, variant.name));
    compare(finder(question.scene, 1), question.expected,
            add_to(Invariant::room, "with room for one entry"));

    std::vector<std::uint64_t> hashes = {hash_of(found)};
    for (int repeat = 0; repeat < repeats; ++repeat)
        hashes.push_back(hash_of(finder(question.scene, 0)));
    if (repeats > 0)
        findings[Invariant::same] = judge_repeats(hashes);
    return findings;
}

}  // namespace bvhbench
