// SPDX-License-Identifier: MIT
//
// Tests that every tuning target is correct with each value of each parameter, one at a time, and that errors are reported.
#include "harness/tune/trials.h"

#include "builders/parameters.h"
#include "collide/parameters.h"
#include "harness/base/failure.h"
#include "tests/case_name.h"

namespace bvhbench {
namespace {

struct Tunable {
    const char* target;
    const char* builder = "oibvh-multi";
    const char* order = "morton30";
    bool sorted_leaves = false;
    const char* narrow = "none";
    const char* scene = "torus:1500";
    bool only_in_groups = false;  ///< whether all its parameters are of the form for many lanes
};

std::string name_of(const Tunable& tested)
{
    return test_name(std::string(tested.target) + '_' + tested.builder + '_' + tested.order);
}

class Trials : public testing::TestWithParam<Tunable> {
protected:
    TuneTask task() const
    {
        TuneTask task{GetParam().target, GetParam().scene, {}, {}};
        task.builder.name = GetParam().builder;
        task.builder.order = GetParam().order;
        task.builder.sorted_leaves = GetParam().sorted_leaves;
        task.collider.narrow = GetParam().narrow;
        return task;
    }
};

TEST_P(Trials, AreRightWithEveryCandidateThatTheDeviceCanDo)
{
    Session session(CommonOptions{});
    TuneTarget target(session, task());
    const auto first = target.trial({});
    EXPECT_EQ(first->wrong(), "");
    if (GetParam().only_in_groups && session.device().is_cpu())
        GTEST_SKIP() << "no parameter in the form for few cores";
    int wanted = 0, right = 0;
    for (const Parameter* parameter : first->asked()) {
        if (!target.wants(*parameter))
            continue;
        ++wanted;
        for (const uint value : parameter->candidates) {
            Tuning tuning;
            tuning.set(*parameter, value);
            std::string wrong;
            const std::string impossible = reason_of_failure([&] {
                const auto trial = target.trial(tuning);
                wrong = trial->wrong();
                ASSERT_FALSE(trial->once().empty());
            });
            EXPECT_EQ(wrong, "") << parameter->name << " = " << value;
            right += impossible.empty() ? 1 : 0;
        }
    }
    EXPECT_GT(wanted, 0) << "nothing to tune";
    EXPECT_GT(right, wanted) << "hardly any value is possible";
}

INSTANTIATE_TEST_SUITE_P(
    Targets, Trials,
    testing::Values(
        Tunable{"sort", "oibvh-multi", "morton63"},
        Tunable{"oibvh-multi", "oibvh-multi", "morton30", true},
        Tunable{"oibvh-multi", "oibvh-multi", "kd"}, Tunable{"group", "apetrei-fused"},
        Tunable{"lbvh-levels", "lbvh-levels"},
        Tunable{"bvtt", "oibvh-multi", "morton30", true, "exact"},
        Tunable{.target = "front", .only_in_groups = true},
        Tunable{.target = "front-leaf", .scene = "cloth-ball:1500:3", .only_in_groups = true},
        Tunable{.target = "leaf", .narrow = "exact", .scene = "cloth-ball:1500:3"},
        Tunable{.target = "grid", .builder = "none", .only_in_groups = true}),
    CaseName());

TEST(TuneTarget, MovesAFrontToTheSecondFrame)
{
    Session session(CommonOptions{});
    TuneTarget target(session, {"front-leaf", "cloth-ball:1500:3", {.name = "apetrei-fused"}, {}});
    for (int k = 0; k < 2; ++k) {
        const auto trial = target.trial({});
        EXPECT_EQ(trial->wrong(), "");
        const std::vector<StageTime> stages = trial->once();
        const auto has = [&](std::string_view stage) {
            return std::ranges::count(stages, stage, &StageTime::stage) > 0;
        };
        EXPECT_TRUE(has("refit") && !has("sort"));
    }
}

TEST(TuneTarget, LeavesWhatIsNotItsOwnAlone)
{
    Session session(CommonOptions{});
    TuneTarget leaf(session, {"leaf", "soup:10", {.name = "perfect"}, {}});
    EXPECT_TRUE(leaf.wants(walk_task_leaves));
    EXPECT_FALSE(leaf.wants(sort_chunk_digit_bits));
    EXPECT_FALSE(leaf.wants(chunks_per_core));
    TuneTarget sort(session, {"sort", "soup:10", {}, {}});
    EXPECT_TRUE(sort.wants(sort_chunk_digit_bits));
    EXPECT_FALSE(sort.wants(chunks_per_core));
    TuneTarget builder(session, {"perfect", "soup:10", {}, {}});
    EXPECT_TRUE(builder.wants(chunks_per_core));
}

}  // namespace
}  // namespace bvhbench
