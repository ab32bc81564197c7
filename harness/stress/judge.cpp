// SPDX-License-Identifier: MIT
#include "harness/stress/judge.h"

#include "builders/host_tree.h"
#include "harness/judge/pair_counts.h"

namespace bvhbench {
namespace {

using enum Finding::Verdict;

/// Compares those lists that the system computes and whose answer is known.
Findings compared(const FoundPairs& found, const FoundPairs& expected)
{
    Findings findings;
    if (found.pairs && expected.pairs)
        findings[Invariant::pairs] = judge_pairs(*found.pairs, *expected.pairs, found.is_rounded);
    if (found.contacts && expected.contacts)
        findings[Invariant::contacts] = judge_pairs(*found.contacts, *expected.contacts);
    return findings;
}

}  // namespace

Findings judge_tree(const HostTree& tree, std::span<const Point> points,
                    std::span<const Face> faces)
{
    const Violation violation = first_violation(tree, points, faces);
    Findings findings = {{Invariant::leaves, {holds, faces.size()}},
                         {Invariant::boxes, {holds, tree.nodes.size()}}};
    if (violation.of != Violation::Of::nothing) {
        Finding& of =
            findings[violation.of == Violation::Of::leaves ? Invariant::leaves : Invariant::boxes];
        of.verdict = broken;
        of.detail = violation.sentence;
    }
    return findings;
}

Finding judge_pairs(const PairList& found, const PairList& expected, bool may_add)
{
    const Differences differing = differences(found, expected);
    const std::uint64_t twice = found.surplus();
    const std::uint64_t added = may_add ? 0 : differing.false_ones - twice;
    Finding finding{holds, expected.size(), differing.missed + added + twice, differing.missed};
    if (finding.wrong > 0) {
        finding.verdict = broken;
        finding.detail = std::to_string(finding.missed) + " missed, " +
                         (may_add ? "" : std::to_string(added) + " false, ") +
                         std::to_string(twice) + " twice, of " + std::to_string(expected.size());
    }
    return finding;
}

Finding judge_repeats(int repeats, const std::function<bool()>& run)
{
    Finding finding{holds, static_cast<std::uint64_t>(repeats) + 1};
    for (int repeat = 0; repeat < repeats; ++repeat)
        finding.wrong += run() ? 0 : 1;
    if (finding.wrong > 0) {
        finding.verdict = broken;
        finding.detail = std::to_string(finding.wrong) + " of " + std::to_string(finding.checked) +
                         " runs left something else than the first";
    }
    return finding;
}

Findings judge_finder(const PairFinder& finder, const StressQuestion& question)
{
    Findings findings = compared(finder(question.scene, 0), question.expected);
    const auto add = [&](Invariant invariant, std::string_view words, const FoundPairs& found,
                         const FoundPairs& expected) {
        for (const auto& [of, finding] : compared(found, expected))
            join(findings, with_words(words, {{invariant, finding}}));
    };
    for (const auto& [of, name, moved, expected] : question.variants) {
        FoundPairs found = finder(moved.scene, 0);
        for (auto* list : {&found.pairs, &found.contacts})
            if (*list)
                *list = renumbered(**list, moved.original);
        add(of, name, found, expected);
    }
    add(Invariant::room, "with room for one entry", finder(question.scene, 1), question.expected);
    return findings;
}

}  // namespace bvhbench
