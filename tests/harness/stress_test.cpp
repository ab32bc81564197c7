// SPDX-License-Identifier: MIT
//
// Tests that `stress` detects wrong trees, pairs and repetitions that are planted here, and that scenes and variants are what
// they claim to be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "builders/host_tree.h"
#include "collide/oracles/box_pairs.h"
#include "collide/oracles/exact_reference.h"
#include "geometry/error.h"
#include "harness/stress/libraries.h"
#include "harness/stress/run.h"
#include "tests/harness/host_lbvh.h"

namespace bvhbench {
namespace {

using enum Finding::Verdict;

const StressSize small{.quick = true, .seed = 7};

StressScene spheres() { return crossed_spheres(120, 7); }

/// Returns the correct answer over a scene.
FoundPairs right_answer(const StressScene& scene)
{
    FoundPairs found;
    found.pairs = touching_pairs(scene.mesh.points, scene.mesh.faces, true);
    if (has_exact_reference)
        found.contacts =
            intersecting_pairs(scene.mesh.points, scene.mesh.faces, found.pairs->pairs(), true);
    return found;
}

/// Returns the pairs without the last one.
PairList shortened(const PairList& pairs)
{
    return PairList({pairs.pairs().begin(), pairs.pairs().end() - 1});
}

Findings judged(const HostTree& tree, const Mesh& mesh)
{
    return judge_tree(tree, mesh.points, mesh.faces);
}

TEST(StressTree, NoticesAMissingLeafABoxThatIsTooSmallAndOneThatIsTooLarge)
{
    const Mesh mesh = spheres().mesh;
    const HostTree right = host_chain(mesh);
    EXPECT_EQ(judged(right, mesh).at(Invariant::leaves).verdict, holds);
    EXPECT_EQ(judged(right, mesh).at(Invariant::boxes).verdict, holds);

    HostTree wrong = right;
    wrong.nodes[1].primitive = wrong.nodes[3].primitive;
    wrong = refitted(std::move(wrong), mesh.points, mesh.faces);  // makes the boxes correct
    EXPECT_EQ(judged(wrong, mesh).at(Invariant::leaves).verdict, broken);
    EXPECT_EQ(judged(wrong, mesh).at(Invariant::boxes).verdict, holds);
    for (const float direction : {-1e30f, 1e30f}) {
        wrong = right;
        wrong.nodes[2].box.max_x = std::nextafter(wrong.nodes[2].box.max_x, direction);
        const Findings findings = judged(wrong, mesh);
        EXPECT_EQ(findings.at(Invariant::boxes).verdict, broken);
        EXPECT_EQ(findings.at(Invariant::leaves).verdict, holds);
        EXPECT_NE(findings.at(Invariant::boxes).detail, "");
    }
}

TEST(StressPairs, CountWhatIsMissedFalseAndTwice)
{
    const PairList expected({{0, 1}, {1, 2}, {2, 3}, {3, 4}});
    const PairList other({{0, 1}, {1, 0}, {1, 2}, {0, 9}});
    EXPECT_EQ(judge_pairs(expected, expected), (Finding{holds, 4, 0, 0, ""}));
    EXPECT_EQ(judge_pairs(other, expected),
              (Finding{broken, 4, 4, 2, "2 missed, 1 false, 1 twice, of 4"}));
    // Boxes that were rounded outward may add pairs.
    EXPECT_EQ(judge_pairs(other, expected, true),
              (Finding{broken, 4, 3, 2, "2 missed, 1 twice, of 4"}));
    EXPECT_EQ(judge_pairs(PairList({{0, 1}, {0, 9}, {1, 2}, {2, 3}, {3, 4}}), expected, true),
              (Finding{holds, 4, 0, 0, ""}));
}

TEST(StressRepeats, NoticeOneRunThatLeavesSomethingElse)
{
    EXPECT_EQ(judge_repeats(2, [] { return true; }), (Finding{holds, 3}));
    int run = 0;
    EXPECT_EQ(judge_repeats(2, [&] { return ++run < 2; }),
              (Finding{broken, 3, 1, 0, "1 of 3 runs left something else than the first"}));
}

/// Returns the findings about a system whose correct answers are altered by `change`, which gets the number of the run.
template <class Change>
Findings judged_with(const Change& change)
{
    static const StressQuestion question = question_of(spheres(), 3);
    EXPECT_EQ(question.variants.size(), 4u);  // shuffled, swapped, scaled, translated
    EXPECT_GT(question.expected.pairs->size(), 500u);
    std::size_t run = 0;
    return judge_finder(
        [&](const StressScene& scene, std::size_t) {
            FoundPairs found = right_answer(scene);
            change(found, run++);
            return found;
        },
        question);
}

TEST(StressFinder, HoldsContactsBehindRoundedBoxesToAllOfThemAndNoOthers)
{
    const auto with_another = [](bool is_rounded, bool drops) {
        return judged_with([=](FoundPairs& found, std::size_t) {
            std::vector<Pair> more(found.pairs->pairs().begin(), found.pairs->pairs().end());
            more.push_back({0, static_cast<uint>(spheres().mesh.faces.size()) - 1});
            found.pairs = PairList(std::move(more));
            if (drops && found.contacts)
                found.contacts = shortened(*found.contacts);
            found.is_rounded = is_rounded;
        });
    };
    EXPECT_EQ(with_another(true, false).at(Invariant::pairs).verdict, holds);
    EXPECT_EQ(with_another(false, false).at(Invariant::pairs).verdict, broken);
    if (has_exact_reference) {
        EXPECT_EQ(with_another(true, true).at(Invariant::contacts).verdict, broken);
    }
}

TEST(StressFinder, NoticesAPairThatIsDroppedInAnyOfItsRuns)
{
    const Invariant by_run[] = {Invariant::pairs, Invariant::agree, Invariant::agree,
                                Invariant::moved, Invariant::moved, Invariant::room};
    for (std::size_t wrong = 0; wrong <= std::size(by_run); ++wrong) {  // the last alters no run
        const Findings findings = judged_with([&](FoundPairs& found, std::size_t run) {
            if (run == wrong)
                found.pairs = shortened(*found.pairs);
        });
        EXPECT_EQ(findings.size(), has_exact_reference ? 5u : 4u);
        for (const auto& [invariant, finding] : findings) {
            const bool is_it = wrong < std::size(by_run) && invariant == by_run[wrong];
            EXPECT_EQ(finding.verdict, is_it ? broken : holds)
                << wrong << ", " << name_of(invariant) << ": " << finding.detail;
            EXPECT_EQ(finding.missed, is_it ? 1u : 0u) << wrong;
        }
    }
}

TEST(StressFinder, NoticesAContactThatIsFalse)
{
    if (!has_exact_reference)
        GTEST_SKIP() << "built without CGAL";
    const Findings findings =
        judged_with([](FoundPairs& found, std::size_t) { found.contacts = found.pairs; });
    EXPECT_EQ(findings.at(Invariant::contacts).verdict, broken);
    EXPECT_EQ(findings.at(Invariant::contacts).missed, 0u);
    EXPECT_EQ(findings.at(Invariant::pairs).verdict, holds);
}

/// Returns the finding `ends` of a system that throws Error.
template <class Error>
Finding end_after(bool may_refuse)
{
    static Session& session = *new Session(CommonOptions{});  // never destroyed: no driver at exit
    return findings_of(session, may_refuse, []() -> Findings { throw Error("too large"); })
        .at(Invariant::ends);
}

TEST(StressSettled, TellsARefusalFromAFailure)
{
    EXPECT_EQ(end_after<Unavailable>(false), (Finding{broken, 1, 1, 0, "too large"}));
    EXPECT_EQ(end_after<Unavailable>(true), (Finding{refused, 1, 0, 0, "too large"}));
    EXPECT_EQ(end_after<BadUsage>(false), (Finding{refused, 1, 0, 0, "too large"}));
}

TEST(StressVariants, AreTheSameScenesInOtherWords)
{
    for (const StressFamily& family : stress_families()) {
        if (family.name == "not-finite")
            continue;
        for (const StressCase& one : family.cases(small)) {
            SCOPED_TRACE(std::string(family.name) + ", " + one.name);
            const StressScene scene = one.make();
            std::size_t covered = 0;
            for (const FaceRange& range : scene.objects) {
                EXPECT_EQ(range.first, covered);
                covered += range.count;
            }
            EXPECT_EQ(covered, scene.mesh.faces.size());
            // Also a test of the sweep: it has no tree, but it sorts.
            for (const StressQuestion question = question_of(scene, 5);
                 const StressVariant& variant : question.variants)
                EXPECT_EQ(
                    renumbered(*right_answer(variant.moved.scene).pairs, variant.moved.original),
                    *variant.expected.pairs)
                    << variant.name;
        }
    }
}

TEST(StressVariants, LeaveOutAScaleOrTranslationThatWouldRound)
{
    StressScene scene = spheres();
    scene.mesh.points.front() = {3e38f, 0x1.000002p-126f, 0};  // can be scaled neither up nor down
    EXPECT_FALSE(scaled(scene, 1));
    EXPECT_FALSE(translated(scene));
    EXPECT_TRUE(scaled(spheres(), 1));
    const auto translation = translated(spheres());
    ASSERT_TRUE(translation);
    const auto& [snapped, moved] = *translation;
    for (std::size_t k = 0; k < snapped.mesh.points.size(); ++k) {
        const double before = snapped.mesh.points[k].x;
        const double after = moved.mesh.points[k].x;
        EXPECT_EQ(after - before, 16.0)
            << "spheres of a unit or so reach to 2, and are moved by eight times that";
    }
}

TEST(StressLibraries, FinitePartLeavesOutTrianglesWithoutAPlace)
{
    const auto family = std::ranges::find(stress_families(), "not-finite", &StressFamily::name);
    for (const StressCase& one : family->cases(small)) {
        const StressScene scene = one.make();
        const Rearranged finite = finite_part(scene);
        EXPECT_LT(finite.original.size(), scene.mesh.faces.size()) << one.name;
        EXPECT_GT(finite.original.size(), scene.mesh.faces.size() / 2) << one.name;
        EXPECT_EQ(finite.scene.objects.size(), scene.objects.size());
        for (std::size_t k = 0; k < finite.original.size(); ++k)
            EXPECT_EQ(finite.scene.mesh.faces[k].b, scene.mesh.faces[finite.original[k]].b);
    }
}

TEST(StressLayout, HoldsAndCountsWhatItLookedAt)
{
    const Finding finding = judge_layout_formulas(small).at(Invariant::layout);
    EXPECT_EQ(finding.verdict, holds) << finding.detail;
    EXPECT_GT(finding.checked, 20000u);
}

TEST(StressRun, TellsOfASceneThatTheDeviceHasNoRoomForAndGoesOn)
{
    Device device = open_device("");
    device.memory_limit = 131072;
    Session full(std::move(device), SceneLibrary{});
    StressTask task;
    task.size = {false, 1};  // 5,000 triangles
    task.filter = cell_filter("^scale/1e(10|17)/(oibvh-multi|device)$");
    std::vector<StressCell> cells;
    stress_all(full, task, [&](StressCell&& cell) { cells.push_back(std::move(cell)); });
    ASSERT_EQ(cells.size(), 2u);  // the filter excludes all other scenes
    for (const StressCell& cell : cells) {
        EXPECT_EQ(cell.family, "scale");
        EXPECT_EQ(cell.system, "device");
        EXPECT_TRUE(is_our_fault(cell));
        EXPECT_NE(cell.findings.at(Invariant::ends).detail.find("out of device memory"),
                  std::string::npos);
    }
}

TEST(StressFindings, OfOursAreToldFromThoseOfLibraries)
{
    StressCell ours;
    ours.family = "scale", ours.scene = "1e20", ours.system = "leaf over karras";
    ours.kind = StressCell::Kind::collider;
    ours.findings = {{Invariant::pairs, {holds, 10}}};
    StressCell theirs = ours;
    theirs.system = "rtcCollide", theirs.kind = StressCell::Kind::library,
    theirs.library = "Embree";
    theirs.findings = {{Invariant::pairs, judge_pairs(PairList(), PairList({{0, 1}, {0, 2}}))}};
    EXPECT_FALSE(is_our_fault(theirs));
    EXPECT_FALSE(is_our_fault(ours));
    ours.findings = {{Invariant::ends, {refused, 1, 0, 0, "out of device memory"}}};
    EXPECT_TRUE(is_refused(ours));
    ours.findings[Invariant::room] = {broken, 10, 1, 1, "1 missed, 0 false, 0 twice, of 10"};
    EXPECT_TRUE(is_our_fault(ours));
}

TEST(StressFindings, JoinedKeepTheWorseVerdict)
{
    Findings all = {{Invariant::ends, {holds, 1}}};
    join(all, {{Invariant::ends, {refused, 1, 0, 0, "too large"}}, {Invariant::room, {holds, 3}}});
    EXPECT_EQ(all[Invariant::ends], (Finding{refused, 2, 0, 0, "too large"}));
    join(all, {{Invariant::ends, {broken, 1, 1, 0, "lost"}}});
    join(all, {{Invariant::ends, {holds, 1}}});
    EXPECT_EQ(all[Invariant::ends], (Finding{broken, 4, 1, 0, "lost"}));
    EXPECT_EQ(all[Invariant::room], (Finding{holds, 3}));
}

}  // namespace
}  // namespace bvhbench
