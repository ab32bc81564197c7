// SPDX-License-Identifier: MIT
//
// The queue of pairs of nodes, `bvtt`: its jumps, its start levels and its counters.
#include "collide/parameters.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

class Bvtt : public testing::TestWithParam<KernelForm> {
protected:
    /// Tests every jump up to `most_jump` with every start level.
    static void expect_oracles_pairs_of_all(const Standing& standing, unsigned most_jump,
                                            std::initializer_list<unsigned> start_levels)
    {
        for (unsigned jump = 1; jump <= most_jump; ++jump)
            for (const unsigned start_level : start_levels) {
                SCOPED_TRACE("jump " + std::to_string(jump) + " from level " +
                             std::to_string(start_level));
                const auto bvtt =
                    made("bvtt", {.jump = jump, .start_level = start_level, .form = GetParam()});
                expect_oracles_pairs(*bvtt, standing);
                EXPECT_GE(bvtt->counts(session().queue()).bvtt_peak, 1u);
            }
    }
};

TEST_P(Bvtt, FindsTheSameWhateverItJumpsAndWhereverItStarts)
{
    for (const std::size_t size : {2u, 3u, 9u, 700u}) {
        SCOPED_TRACE(size);
        expect_oracles_pairs_of_all({crowded_mesh(size), "oibvh-multi"}, 5, {0, 1, 3, 7});
    }
}

TEST_P(Bvtt, JumpsAndStartsBelowTheRootOfWideTreesAsFarAsTheyAllow)
{
    const Standing standing(crowded_mesh(700), "oibvh-wide4");
    expect_oracles_pairs_of_all(standing, 2, {0, 1, 3, 6});
    for (const ColliderOptions& options :
         {ColliderOptions{.jump = 3}, ColliderOptions{.start_level = 7}}) {
        const auto bvtt = made("bvtt", options);
        EXPECT_EQ(bvtt->refusal(*standing.tree),
                  "bvtt jumps at most 2 levels and starts on level 6 at most where a node has 4 "
                  "children");
    }
}

TEST_P(Bvtt, JumpsAndStartsBelowTheRootsOfSeveralObjects)
{
    const ManyObjects many({1, 70, 3, 2, 129, 200, 1});
    expect_oracles_pairs_of_all(many.standing(find_builder("oibvh-multi").make), 3, {0, 3, 12});
}

TEST_P(Bvtt, TakesTunedLevelsForThoseOfBinaryTrees)
{
    Device device = session().device();
    device.tuning.set(bvtt_start_level, 12);
    device.tuning.set(bvtt_jump, 4);
    Programs programs(device);
    const Standing standing(crowded_mesh(700), "oibvh-wide4");
    const auto tuned = find_collider("bvtt").make(programs, {.form = GetParam()});
    expect_oracles_pairs(*tuned, standing);
    const auto asked = made("bvtt", {.jump = 2, .start_level = 6, .form = GetParam()});
    expect_oracles_pairs(*asked, standing);
    EXPECT_EQ(tuned->counts(session().queue()).box_tests,
              asked->counts(session().queue()).box_tests);
}

TEST_P(Bvtt, CountsWhatAHandCounts)
{
    // Four triangles in a row, each overlapping the next; the levels of the tree are 01 23 and 0 1 2 3.
    const Standing standing(collinear_mesh(4), "oibvh-multi");
    const auto bvtt = made("bvtt", {.form = GetParam()});
    expect_oracles_pairs(*bvtt, standing);
    const QueryCounts counts = bvtt->counts(session().queue());
    EXPECT_EQ(counts.pairs, 5u);      // 01 12 23, and 02 13 because triangles are 2.5 long
    EXPECT_EQ(counts.box_tests, 7u);  // (01, 23); 01; 23; 02 03 12 13
    EXPECT_EQ(counts.bvtt_peak, 3u);  // (01, 01), (23, 23), (01, 23)
}

TEST_P(Bvtt, RefusesWhatAnArithmeticWouldBeNeededFor)
{
    const Standing standing(crowded_mesh(20), "karras");
    for (const ColliderOptions& options :
         {ColliderOptions{.jump = 2}, ColliderOptions{.start_level = 1}})
        EXPECT_THROW(made("bvtt", options)->reserve(standing.tree, standing.input), BadUsage);
    EXPECT_THROW(made("bvtt", {.jump = 6}), BadUsage);
    EXPECT_THROW(made("bvtt", {.start_level = 13}), BadUsage);
    EXPECT_THROW(made("bvtt", {.group_size = 48}), BadUsage);
}

INSTANTIATE_TEST_SUITE_P(Forms, Bvtt, both_forms, CaseName());

}  // namespace
}  // namespace bvhbench
