// SPDX-License-Identifier: MIT
//
// Front tracking over frames that move a little, jump, part and return: every frame has the oracle's pairs, each once.
#include "tests/collide/tracked_front.h"

namespace bvhbench {
namespace {

/// Both fronts with each builder whose trees they can track: front-leaf takes binary ones only.
std::vector<ColliderCase> cases()
{
    const ColliderEntry fronts[] = {find_collider("front"), find_collider("front-leaf")};
    std::vector<ColliderCase> all = with_each_builder(fronts);
    std::erase_if(all, [](const ColliderCase& one) {
        const auto& [front, builder, form, leaves] = one;
        const Standing standing(crowded_mesh(3), builder.make);
        return front.name == "front-leaf" && standing.device_tree().child_bits() > 1;
    });
    return all;
}

class FrontOver : public testing::TestWithParam<ColliderCase> {
protected:
    std::string_view front() const { return std::get<0>(GetParam()).name; }
    MakeBuilder make() const { return std::get<1>(GetParam()).make; }
    KernelForm form() const { return std::get<2>(GetParam()); }
    BuildOptions build() const
    {
        return {.sorted_leaves = std::get<3>(GetParam()) == Leaves::sorted};
    }

    const Moving moving;
};

/// Runs small motions, and jumps that deform all triangles.
void run_all(Tracked& tracked, const Moving& moving)
{
    int frame = 0;
    for (const float by : {0.0f, 0.01f, 0.02f, 5.0f, 5.0f, 0.02f, 5.0f, 5.0f, 1.5f, 1.49f, 0.0f}) {
        SCOPED_TRACE("frame " + std::to_string(frame));
        tracked.expect_pairs_at(moving.moved(by, by > 1 ? 40 : ++frame));
    }
    EXPECT_GT(tracked.refits, 5);
}

TEST_P(FrontOver, FindsTheOraclesPairsInEveryFrameOfOneObject)
{
    for (const bool keep_adjacent : {true, false})
        for (const std::size_t capacity : {0u, 1u}) {
            const bool is_large = capacity == 0, has_groups = form() == KernelForm::groups;
            if (!takes_all_cases() &&
                (keep_adjacent != (is_large == has_groups) || is_large != build().sorted_leaves))
                continue;
            SCOPED_TRACE(std::to_string(keep_adjacent) + std::to_string(capacity));
            Tracked tracked(moving, true, make(), front(),
                            {.keep_adjacent = keep_adjacent, .form = form(), .capacity = capacity},
                            build());
            run_all(tracked, moving);
            EXPECT_GE(tracked.counted().at("restarts_count"), 1);
        }
}

TEST_P(FrontOver, FindsTheOraclesPairsInEveryFrameOfSeveralObjects)
{
    for (const Among among : {Among::all, Among::between_objects, Among::within_objects}) {
        SCOPED_TRACE(static_cast<int>(among));
        Tracked tracked(moving, false, make(), front(),
                        {.among = among, .form = form(), .capacity = among == Among::all ? 1u : 0u},
                        build());
        run_all(tracked, moving);
    }
}

TEST_P(FrontOver, NoticesObjectsThatComeBack)
{
    Tracked tracked(moving, false, make(), front(),
                    {.among = Among::between_objects, .form = form()}, build());
    const auto move_to = [&](float x) {
        SCOPED_TRACE(x);
        tracked.expect_pairs_at(moving.moved(0, 0, x));
    };
    for (const float x : {0.0f, 0.2f, 0.9f, 50.0f})
        move_to(x);
    for (int frame = 0; frame < 17; ++frame)
        move_to(50);
    // A pair of objects has an entry for their roots, or one for each leaf of the first and the root of the second.
    EXPECT_EQ(tracked.counted().at("front_count"), front() == "front" ? 6 : moving.far_entries());
    for (const float x : {50.1f, 0.9f, 0.2f, 0.0f})
        move_to(x);
}

TEST_P(FrontOver, IsKeptWhereNothingMoves)
{
    Tracked tracked(moving, true, make(), front(), {.form = form()}, build());
    tracked.expect_pairs_at(moving.moved(0.01f, 1));
    const auto first = tracked.counted();
    tracked.expect_the_same_again();
    for (int repeat = 0; repeat < 18; ++repeat) {  // one of these frames maintains
        tracked.expect_pairs_at(moving.moved(0.01f, 1));
        const auto still = tracked.counted();
        EXPECT_EQ(still.at("front_count"), first.at("front_count"));
        EXPECT_EQ(tracked.below(), 0);
        EXPECT_EQ(still.at("prunes_count"), 0);
        if (repeat == 0) {
            EXPECT_LT(still.at("tests"), first.at("tests"));
        }
        tracked.expect_the_same_again();
    }
    EXPECT_EQ(tracked.refits, 18);
}

TEST_P(FrontOver, MayBeRepeatedWhileItMoves)
{
    Tracked tracked(moving, false, make(), front(), {.form = form()}, build());
    const int frames = takes_few_cases() ? 4 : 6, repeats = takes_few_cases() ? 1 : 3;
    for (int frame = 0; frame < frames; ++frame) {
        tracked.expect_pairs_at(moving.moved(0.03f, frame));
        for (int repeat = 0; repeat < repeats; ++repeat)
            tracked.expect_the_same_again();
    }
    EXPECT_GE(tracked.refits, 3);
}

TEST_P(FrontOver, ClimbsBackWhenItHasGrown)
{
    // Over the same tree, a front just maintained depends on the points alone, not on the frames before.
    for (const bool as_one : {true, false}) {
        Tracked tracked(moving, as_one, make(), front(), {.form = form()}, build());
        tracked.expect_pairs_at(moving.moved(0, 0));
        const double first = tracked.counted().at("front_count");
        tracked.expect_pairs_at(moving.moved(0.15f, 40));
        EXPECT_EQ(tracked.counted().at("front_count"), first);
        EXPECT_GT(tracked.below(), 0);
        for (int frame = 0; frame < 17; ++frame)
            tracked.expect_pairs_at(moving.moved(0.15f, 40));
        const double grown = tracked.counted().at("front_count");
        EXPECT_GT(grown, first);
        ASSERT_LT(grown, 2 * first);  // else the tree would be rebuilt
        for (int frame = 0; frame < 17; ++frame)
            tracked.expect_pairs_at(moving.moved(0, 0));
        EXPECT_EQ(tracked.counted().at("front_count"), first);
        EXPECT_GT(tracked.prunes, 0);
        tracked.expect_the_same_again();
    }
}

INSTANTIATE_TEST_SUITE_P(Catalog, FrontOver, testing::ValuesIn(cases()), CaseName());

TEST(FrontPipeline, KeepsItsTreeWhileOthersBuildTheirs)
{
    const Moving moving;
    std::vector<Point> points = moving.mesh.points;
    Input input = uploaded(points, moving.mesh.faces);
    const BuilderChoice builder{.name = "oibvh-multi"};
    Pipeline tracking(session(), builder, {.name = "front"}, input),
        walking(session(), builder, {.name = "leaf"}, input);
    for (int frame = 0; frame < 6; ++frame) {
        points = moving.moved(0.02f, frame);
        for (Pipeline* one : {&tracking, &walking})
            go_to(points, *one, input);
        for (int repeat = 0; repeat < 3; ++repeat)
            for (Pipeline* one : {&walking, &tracking}) {
                const std::vector<StageTime> stages = one->once(input);
                EXPECT_EQ(std::ranges::count(stages, "refit", &StageTime::stage) > 0,
                          one == &tracking && frame > 0);
                EXPECT_EQ(PairList(one->pairs()), touching_pairs(points, moving.mesh.faces, true));
            }
    }
}

TEST(Front, RefusesWideTrees)
{
    const Standing standing(crowded_mesh(90), "oibvh-wide4");
    EXPECT_FALSE(takes(*made("front-leaf"), standing));
}

TEST(Front, RefusesToJump)
{
    for (const ColliderOptions& options :
         {ColliderOptions{.jump = 2}, ColliderOptions{.start_level = 1}})
        for (const char* name : {"front", "front-leaf"})
            EXPECT_THROW(made(name, options), BadUsage);
}

}  // namespace
}  // namespace bvhbench
