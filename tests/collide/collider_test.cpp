// SPDX-License-Identifier: MIT
//
// Every collider of the catalog finds the oracle's pairs on every device tree. A new one is tested the moment it is
// listed, as is a new builder.
#include <span>

#include "builders/device_tree.h"
#include "collide/parameters.h"
#include "tests/collide/collider_testing.h"

namespace bvhbench {
namespace {

constexpr std::size_t few_sizes[] = {1, 2, 3, 5, 8, 33, 65}, fewer_sizes[] = {1, 3, 33};

class ColliderContract
    : public testing::TestWithParam<std::tuple<ColliderEntry, BuilderEntry, KernelForm>> {
protected:
    const ColliderEntry& collider() const { return std::get<0>(GetParam()); }
    const BuilderEntry& builder() const { return std::get<1>(GetParam()); }
    KernelForm form() const { return std::get<2>(GetParam()); }
    ColliderOptions options() const { return {.form = form()}; }

    /// The form of the device over all trees, and the other one over the first of those that are the same tree.
    bool is_thorough() const
    {
        const bool is_own = (form() == KernelForm::chunks) == session().device().is_cpu();
        const auto same = [&](const BuilderEntry& other) {
            return other.oracle == builder().oracle;
        };
        const auto all = device_builders();
        return is_own || builder().oracle.empty() ||
               std::find_if(all.begin(), all.end(), same)->name == builder().name;
    }

    std::unique_ptr<Collider> made(const ColliderOptions& options) const
    {
        return collider().make(session().programs(), options);
    }
};

TEST_P(ColliderContract, FindsTheOraclesPairsOfFew)
{
    const auto one = made(options());
    EXPECT_EQ(one->card().name, collider().name);
    const std::span<const std::size_t> all(few_sizes), some(fewer_sizes);
    for (const std::size_t size : is_thorough() ? all : some)
        for (const auto& [name, mesh] : hard_meshes(size)) {
            SCOPED_TRACE(name + ", " + std::to_string(size) + " triangles");
            expect_oracles_pairs(*one, Standing(mesh, builder().make), true);
        }
}

TEST_P(ColliderContract, FindsTheOraclesPairsOfMany)
{
    ColliderOptions wanted = options();
    for (const bool keep_adjacent : {true, false}) {
        wanted.keep_adjacent = keep_adjacent;
        const auto one = made(wanted);
        for (const auto& [name, mesh] : hard_meshes(is_thorough() ? 777 : 130)) {
            if (!keep_adjacent && !shares_vertices(mesh))
                continue;  // as before
            SCOPED_TRACE(name + (keep_adjacent ? ", adjacent kept" : ", adjacent dropped"));
            expect_oracles_pairs(*one, Standing(mesh, builder().make), keep_adjacent);
        }
    }
}

TEST_P(ColliderContract, DropsNothingWhenBuffersBeginWithOneEntry)
{
    ColliderOptions tiny = options();
    tiny.capacity = 1;
    const auto one = made(tiny);
    for (const auto& [name, mesh] : hard_meshes(300)) {
        SCOPED_TRACE(name);
        expect_oracles_pairs(*one, Standing(mesh, builder().make), true);
    }
}

TEST_P(ColliderContract, WalksSortedLeavesAndOtherOrders)
{
    const auto one = made(options());
    const Mesh mesh = hard_inputs().front().make(1500);
    for (const char* order : {"morton30", "hilbert63"})
        expect_oracles_pairs(
            *one, Standing(mesh, builder().make, {.order = order, .sorted_leaves = true}), true);
}

TEST_P(ColliderContract, CountsTheSameEveryTime)
{
    const auto one = made(options());
    const Standing standing(crowded_mesh(500), builder().make);
    if (!takes(*one, standing))
        return;
    one->reserve(standing.tree, standing.input);
    find_pairs(*one, standing.tree, standing.input, session().queue());
    const QueryCounts first = one->counts(session().queue());
    for (int repeat = 0; repeat < 5; ++repeat) {
        EXPECT_EQ(find_pairs(*one, standing.tree, standing.input, session().queue()), 1);
        const QueryCounts again = one->counts(session().queue());
        EXPECT_EQ(again.pairs, first.pairs);
        EXPECT_EQ(again.box_tests, first.box_tests);
        EXPECT_EQ(again.bvtt_peak, first.bvtt_peak);
    }
    session().queue().finish();
}

INSTANTIATE_TEST_SUITE_P(
    Catalog, ColliderContract,
    testing::Combine(testing::ValuesIn(box_colliders(true)), testing::ValuesIn(device_builders()),
                     testing::Values(KernelForm::groups, KernelForm::chunks)),
    [](const auto& tested) {
        return test_name(std::string(std::get<0>(tested.param).name) + '_' +
                         std::string(std::get<1>(tested.param).name) + '_' +
                         (std::get<2>(tested.param) == KernelForm::groups ? "groups" : "chunks"));
    });

class Bvtt : public testing::TestWithParam<KernelForm> {};

TEST_P(Bvtt, FindsTheSameWhateverItJumpsAndWhereverItStarts)
{
    for (const std::size_t size : {2u, 3u, 9u, 700u}) {
        const Standing standing(crowded_mesh(size), find_builder("oibvh-multi").make);
        for (unsigned jump = 1; jump <= 5; ++jump)
            for (const unsigned start_level : {0u, 1u, 3u, 7u}) {
                SCOPED_TRACE(std::to_string(size) + " triangles, jump " + std::to_string(jump) +
                             " from level " + std::to_string(start_level));
                const auto bvtt = find_collider("bvtt").make(
                    session().programs(),
                    {.jump = jump, .start_level = start_level, .form = GetParam()});
                expect_oracles_pairs(*bvtt, standing, true);
                EXPECT_GE(bvtt->counts(session().queue()).bvtt_peak, 1u);
            }
    }
}

TEST_P(Bvtt, JumpsAndStartsBelowTheRootOfWideTreesAsFarAsTheyAllow)
{
    const Standing standing(crowded_mesh(700), find_builder("oibvh-wide4").make);
    for (unsigned jump = 1; jump <= 2; ++jump)
        for (const unsigned start_level : {0u, 1u, 3u, 6u}) {
            SCOPED_TRACE("jump " + std::to_string(jump) + " from level " +
                         std::to_string(start_level));
            const auto bvtt = find_collider("bvtt").make(
                session().programs(),
                {.jump = jump, .start_level = start_level, .form = GetParam()});
            expect_oracles_pairs(*bvtt, standing, true);
        }
    for (const ColliderOptions& options :
         {ColliderOptions{.jump = 3}, ColliderOptions{.start_level = 7}}) {
        const auto bvtt = find_collider("bvtt").make(session().programs(), options);
        EXPECT_EQ(bvtt->refusal(*standing.tree),
                  "bvtt jumps at most 2 levels and starts on level 6 at most where a node has 4 "
                  "children");
    }
}

TEST_P(Bvtt, TakesTunedLevelsForThoseOfBinaryTrees)
{
    Device device = session().device();
    device.tuning.set(bvtt_start_level, 12);
    device.tuning.set(bvtt_jump, 4);
    Programs programs(device);
    const Standing standing(crowded_mesh(700), find_builder("oibvh-wide4").make);
    const auto tuned = find_collider("bvtt").make(programs, {.form = GetParam()});
    expect_oracles_pairs(*tuned, standing, true);
    const auto asked = find_collider("bvtt").make(
        session().programs(), {.jump = 2, .start_level = 6, .form = GetParam()});
    expect_oracles_pairs(*asked, standing, true);
    EXPECT_EQ(tuned->counts(session().queue()).box_tests,
              asked->counts(session().queue()).box_tests);
}

TEST_P(Bvtt, CountsWhatAHandCounts)
{
    // Four triangles in a row, each overlapping the next: the levels of the tree are 01 23 and 0 1 2 3.
    const Standing standing(collinear_mesh(4), find_builder("oibvh-multi").make);
    const auto bvtt = find_collider("bvtt").make(session().programs(), {.form = GetParam()});
    expect_oracles_pairs(*bvtt, standing, true);
    const QueryCounts counts = bvtt->counts(session().queue());
    EXPECT_EQ(counts.pairs, 5u);      // 01 12 23 and, 2.5 being long, 02 13
    EXPECT_EQ(counts.box_tests, 7u);  // (01, 23); 01; 23; 02 03 12 13
    EXPECT_EQ(counts.bvtt_peak, 3u);  // 01 and 23 with themselves and with each other
}

TEST_P(Bvtt, RefusesWhatAnArithmeticWouldBeNeededFor)
{
    const Standing standing(crowded_mesh(20), find_builder("karras").make);
    for (const ColliderOptions& options :
         {ColliderOptions{.jump = 2}, ColliderOptions{.start_level = 1}})
        EXPECT_THROW(find_collider("bvtt")
                         .make(session().programs(), options)
                         ->reserve(standing.tree, standing.input),
                     BadUsage);
    EXPECT_THROW(find_collider("bvtt").make(session().programs(), {.jump = 6}), BadUsage);
    EXPECT_THROW(find_collider("bvtt").make(session().programs(), {.start_level = 13}), BadUsage);
    EXPECT_THROW(find_collider("bvtt").make(session().programs(), {.group_size = 48}), BadUsage);
}

INSTANTIATE_TEST_SUITE_P(Forms, Bvtt, testing::Values(KernelForm::groups, KernelForm::chunks),
                         [](const auto& tested) {
                             return tested.param == KernelForm::groups ? "groups" : "chunks";
                         });

TEST(Group, IsRightWhereItsFrontierHasNoRoom)
{
    for (const char* builder : {"oibvh-multi", "karras", "oibvh-wide4", "oibvh-wide8"})
        for (const Mesh& mesh : {crowded_mesh(200), hard_inputs()[1].make(70)}) {
            SCOPED_TRACE(builder);
            const auto group = find_collider("group").make(
                session().programs(),
                {.group_size = 32, .form = KernelForm::groups, .capacity = 1});
            expect_oracles_pairs(*group, Standing(mesh, find_builder(builder).make), true);
        }
}

// In between, and those of parameters, are in `bvhbench stress`, family group-sizes.
TEST(Colliders, TakeTheLeastAndTheMostOfGroupSizesAndRefuseOthers)
{
    const Standing standing(crowded_mesh(600), find_builder("karras").make);
    const Standing wide(crowded_mesh(600), find_builder("oibvh-wide8").make);
    for (const char* name : {"leaf", "bvtt", "group", "front"})
        for (const unsigned group_size : {8u, 256u}) {
            SCOPED_TRACE(std::string(name) + ", groups of " + std::to_string(group_size));
            const auto collider = find_collider(name).make(
                session().programs(), {.group_size = group_size, .form = KernelForm::groups});
            expect_oracles_pairs(*collider, standing, true);
            expect_oracles_pairs(*collider, wide, true);
        }
    // Groups of 4 would not take a node of 8 children, ever, and groups of 1 count two things with one work-item.
    for (const unsigned group_size : {1u, 2u, 4u, 48u, 512u})
        EXPECT_THROW(find_collider("leaf").make(session().programs(), {.group_size = group_size}),
                     BadUsage);
}

TEST(Colliders, TakeEveryTreeOnADeviceButBlockBinaryImplicitOnes)
{
    const Mesh mesh = crowded_mesh(20);
    for (const BuilderEntry& builder : device_builders()) {
        const Standing standing(mesh, builder.make);
        const auto& tree = dynamic_cast<const DeviceTree&>(*standing.tree);
        const bool has_blocks = tree.is_implicit() && tree.child_bits() == 1;
        for (const ColliderEntry& entry : box_colliders(true)) {
            const auto collider = entry.make(session().programs(), {});
            EXPECT_EQ(collider->refusal(*standing.tree).empty(),
                      has_blocks || entry.name != "block")
                << entry.name << " over " << builder.name;
        }
    }
}

TEST(Block, FindsTheOraclesPairsWhereItsTreeHasSeveralLevelsOfBlocks)
{
    // Leaves at and beside what five, ten and fifteen levels hold; an order that jumps, and one that does not.
    for (const std::size_t size : {31u, 32u, 1023u, 1024u, 1025u, 32769u})
        for (const char* order : {"morton30", "kd"}) {
            SCOPED_TRACE(std::to_string(size) + " triangles, " + order);
            const auto block =
                find_collider("block").make(session().programs(), {.form = KernelForm::groups});
            const Scene surface = load_scene("torus:" + std::to_string(size), {});
            const Mesh mesh{surface.frames.front(), surface.faces};
            expect_oracles_pairs(
                *block, Standing(mesh, find_builder("oibvh-multi").make, {.order = order}), true);
        }
}

TEST(Block, FindsMorePairsThanATeamKeeps)
{
    // The same triangle 200 times: seven blocks meet each other, more than 256 pairs most times.
    Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, std::vector<Face>(200, Face{0, 1, 2})};
    const auto block =
        find_collider("block").make(session().programs(), {.form = KernelForm::groups});
    const Standing standing(mesh, find_builder("perfect").make);
    expect_oracles_pairs(*block, standing, true);
    EXPECT_EQ(block->counts(session().queue()).pairs, 200u * 199 / 2);
}

// A thousand are in `bvhbench stress`, family repeats.
TEST(Colliders, FindOneSetOfPairsInAHundredRepeats)
{
    const Standing standing(hard_meshes(900).back().mesh, find_builder("oibvh-multi").make);
    for (const ColliderEntry& entry : box_colliders(true)) {
        SCOPED_TRACE(std::string(entry.name));
        const auto collider = entry.make(session().programs(), {});
        collider->reserve(standing.tree, standing.input);
        find_pairs(*collider, standing.tree, standing.input, session().queue());
        const std::uint64_t hash = PairList(collider->pairs(session().queue())).hash();
        int others = 0;
        for (int repeat = 0; repeat < 100; ++repeat) {
            find_pairs(*collider, standing.tree, standing.input, session().queue());
            others += PairList(collider->pairs(session().queue())).hash() != hash ? 1 : 0;
            session().queue().finish();
        }
        EXPECT_EQ(others, 0);
    }
}

TEST(Brute, FindsWhatTheSweepFindsWhateverTheTree)
{
    const Standing standing(crowded_mesh(200), find_builder("median-split").make);
    const auto brute = find_collider("brute").make(session().programs(), {});
    expect_oracles_pairs(*brute, standing, true);
    const auto leaf = find_collider("leaf").make(session().programs(), {});
    EXPECT_EQ(brute->refusal(*standing.tree), "");
    EXPECT_NE(leaf->refusal(*standing.tree), "");
    EXPECT_THROW(leaf->reserve(standing.tree, standing.input), BadUsage);
}

}  // namespace
}  // namespace bvhbench
