// SPDX-License-Identifier: MIT
//
// Every collider of the catalog finds the oracle's pairs on every device tree. A new one is tested the moment it is
// listed, as is a new builder.
#include "tests/collide/collider_testing.h"

namespace bvhbench {
namespace {

constexpr std::size_t few_sizes[] = {1, 2, 3, 4, 5, 8, 9, 33, 64, 65};

class ColliderContract
    : public testing::TestWithParam<std::tuple<ColliderEntry, BuilderEntry, KernelForm>> {
protected:
    const ColliderEntry& collider() const { return std::get<0>(GetParam()); }
    const BuilderEntry& builder() const { return std::get<1>(GetParam()); }
    ColliderOptions options() const { return {.form = std::get<2>(GetParam())}; }

    std::unique_ptr<Collider> made(const ColliderOptions& options) const
    {
        return collider().make(session().programs(), options);
    }
};

TEST_P(ColliderContract, FindsTheOraclesPairsOfFew)
{
    const auto one = made(options());
    EXPECT_EQ(one->card().name, collider().name);
    for (const std::size_t size : few_sizes)
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
        for (const auto& [name, mesh] : hard_meshes(777)) {
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
    one->reserve(*standing.tree);
    find_pairs(*one, *standing.tree, standing.input, session().queue());
    const QueryCounts first = one->counts(session().queue());
    for (int repeat = 0; repeat < 5; ++repeat) {
        EXPECT_EQ(find_pairs(*one, *standing.tree, standing.input, session().queue()), 1);
        const QueryCounts again = one->counts(session().queue());
        EXPECT_EQ(again.pairs, first.pairs);
        EXPECT_EQ(again.box_tests, first.box_tests);
        EXPECT_EQ(again.bvtt_peak, first.bvtt_peak);
    }
    session().queue().finish();
}

std::vector<ColliderEntry> device_colliders()
{
    std::vector<ColliderEntry> colliders(collider_catalog().begin(), collider_catalog().end());
    std::erase_if(colliders, [](const ColliderEntry& entry) { return entry.name == "brute"; });
    return colliders;
}

INSTANTIATE_TEST_SUITE_P(
    Catalog, ColliderContract,
    testing::Combine(testing::ValuesIn(device_colliders()), testing::ValuesIn(device_builders()),
                     testing::Values(KernelForm::groups, KernelForm::chunks)),
    [](const auto& tested) {
        return test_name(std::string(std::get<0>(tested.param).name) + '_' +
                         std::string(std::get<1>(tested.param).name) + '_' +
                         (std::get<2>(tested.param) == KernelForm::groups ? "groups" : "chunks"));
    });

TEST(Brute, FindsWhatTheSweepFindsWhateverTheTree)
{
    const Standing standing(crowded_mesh(200), find_builder("median-split").make);
    const auto brute = find_collider("brute").make(session().programs(), {});
    expect_oracles_pairs(*brute, standing, true);
    const auto leaf = find_collider("leaf").make(session().programs(), {});
    EXPECT_EQ(brute->refusal(*standing.tree), "");
    EXPECT_NE(leaf->refusal(*standing.tree), "");
    EXPECT_THROW(leaf->reserve(*standing.tree), BadUsage);
}

}  // namespace
}  // namespace bvhbench
