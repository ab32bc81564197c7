// SPDX-License-Identifier: MIT
//
// Every collider of the catalog finds the oracle's pairs, on every device tree or without a tree. Colliders and builders are
// tested as soon as they are in the catalogs.

#include "builders/implicit/tree.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

constexpr std::size_t few_sizes[] = {1, 2, 3, 5, 8, 33, 65}, simulated_sizes[] = {1, 5, 65};

std::vector<ColliderCase> cases()
{
    std::vector<ColliderCase> all = with_each_builder(box_colliders(true));
    for (const ColliderEntry& collider : box_colliders(false))
        for (const KernelForm form : {KernelForm::groups, KernelForm::chunks})
            if (!collider.needs_tree && !collider.is_library)
                all.emplace_back(collider, BuilderEntry{"none", "", "", nullptr}, form,
                                 Leaves::as_in_mesh);
    return all;
}

/// Meshes that are hard for builders and queries, one of them with boxes of many sizes.
std::vector<NamedMesh> meshes(std::size_t count)
{
    std::vector<NamedMesh> all = hard_meshes(count);
    all.push_back({"many sizes", mesh_of_many_sizes(static_cast<uint>(count))});
    return all;
}

class ColliderContract : public testing::TestWithParam<ColliderCase> {
protected:
    const ColliderEntry& collider() const { return std::get<0>(GetParam()); }
    const BuilderEntry& builder() const { return std::get<1>(GetParam()); }
    KernelForm form() const { return std::get<2>(GetParam()); }
    ColliderOptions options() const { return {.form = form()}; }

    /// True if the case also takes options whose kernels are compiled anew for each tree and form. At night all cases do.
    bool is_thorough() const
    {
        return takes_all_cases() || builder().make == nullptr ||
               builder().name == builders_to_query().front().name;
    }

    std::unique_ptr<Collider> made(const ColliderOptions& options) const
    {
        return bvhbench::made(collider().name, options);
    }
    Standing standing(const Mesh& mesh) const
    {
        return {mesh, builder().make, {.sorted_leaves = std::get<3>(GetParam()) == Leaves::sorted}};
    }
};

TEST_P(ColliderContract, FindsTheOraclesPairsOfFew)
{
    const auto one = made(options());
    EXPECT_EQ(one->card().name, collider().name);
    using Sizes = std::span<const std::size_t>;
    for (const std::size_t size : takes_few_cases() ? Sizes(simulated_sizes) : Sizes(few_sizes))
        for (const auto& [name, mesh] : meshes(size)) {
            SCOPED_TRACE(name + ", " + std::to_string(size) + " triangles");
            expect_oracles_pairs(*one, standing(mesh));
        }
}

TEST_P(ColliderContract, FindsTheOraclesPairsOfMany)
{
    ColliderOptions wanted = options();
    for (const bool keep_adjacent : {true, false}) {
        if (!keep_adjacent && !is_thorough())
            continue;
        wanted.keep_adjacent = keep_adjacent;
        const auto one = made(wanted);
        for (const auto& [name, mesh] : meshes(777)) {
            if (!keep_adjacent && !shares_vertices(mesh))
                continue;  // same result as with adjacent pairs
            SCOPED_TRACE(name + (keep_adjacent ? ", adjacent kept" : ", adjacent dropped"));
            expect_oracles_pairs(*one, standing(mesh), keep_adjacent);
        }
    }
}

TEST_P(ColliderContract, DropsNothingWhenBuffersBeginWithOneEntry)
{
    ColliderOptions tiny = options();
    tiny.capacity = 1;
    const auto one = made(tiny);
    for (const auto& [name, mesh] : meshes(300)) {
        SCOPED_TRACE(name);
        expect_oracles_pairs(*one, standing(mesh));
    }
}

TEST_P(ColliderContract, CountsTheSameEveryTime)
{
    const auto one = made(options());
    const Standing crowd = standing(crowded_mesh(500));
    if (!takes(*one, crowd))
        return;
    expect_oracles_pairs(*one, crowd);
    const QueryCounts first = one->counts(session().queue());
    for (int repeat = 0; repeat < 5; ++repeat) {
        EXPECT_EQ(expect_pairs(*one, crowd, crowd.expected(true)), 1);
        const QueryCounts again = one->counts(session().queue());
        EXPECT_EQ(again.box_tests, first.box_tests);
        EXPECT_EQ(again.bvtt_peak, first.bvtt_peak);
    }
}

/// As large as the meshes whose pairs a separate program counted (reference_test).
TEST(Colliders, FindTheOraclesPairsOfALargeSurface)
{
    for (const char* builder : {"oibvh-multi", "lbvh-levels"}) {
        const Standing standing(scene_mesh("torus:86482"), builder);
        for (const ColliderEntry& entry : box_colliders(false))
            if (entry.name != "brute" && !entry.is_library) {
                SCOPED_TRACE(std::string(entry.name) + " over " + builder);
                expect_oracles_pairs(*made(entry.name, {.keep_adjacent = false}), standing, false);
            }
    }
}

INSTANTIATE_TEST_SUITE_P(Catalog, ColliderContract, testing::ValuesIn(cases()), CaseName());

TEST(Group, IsRightWhereItsFrontierHasNoRoom)
{
    for (const char* builder : {"oibvh-multi", "karras", "oibvh-wide4", "oibvh-wide8"})
        for (const Mesh& mesh : {crowded_mesh(200), hard_inputs()[1].make(70)}) {
            SCOPED_TRACE(builder);
            const auto group =
                made("group", {.group_size = 32, .form = KernelForm::groups, .capacity = 1});
            expect_oracles_pairs(*group, Standing(mesh, builder));
        }
}

// Sizes in between, and those of parameters, are in `bvhbench stress`, family group-sizes.
TEST(Colliders, TakeTheLeastAndTheMostOfGroupSizesAndRefuseOthers)
{
    const Standing standing(crowded_mesh(600), "karras");
    const Standing wide(crowded_mesh(600), "oibvh-wide8");
    for (const char* name :
         {"leaf", "bvtt", "group", "front", "front-leaf", "grid", "all-pairs", "sort-sweep"})
        for (const unsigned group_size : {8u, 256u}) {
            SCOPED_TRACE(std::string(name) + ", groups of " + std::to_string(group_size));
            const auto collider =
                made(name, {.group_size = group_size, .form = KernelForm::groups});
            expect_oracles_pairs(*collider, group_size == 8 ? wide : standing);
            if (takes_all_cases())
                expect_oracles_pairs(*collider, group_size == 8 ? standing : wide);
        }
    // Groups of 4 could never take a node with 8 children; groups of 1 would have one work-item for two counters.
    for (const unsigned group_size : {1u, 2u, 4u, 48u, 512u})
        EXPECT_THROW(made("leaf", {.group_size = group_size}), BadUsage);
}

TEST(Colliders, TakeEveryTreeOnADeviceButFrontLeafBinaryOnesOnly)
{
    const Mesh mesh = crowded_mesh(20);
    for (const BuilderEntry& builder : device_builders()) {
        const Standing standing(mesh, builder.make);
        const auto& tree = dynamic_cast<const DeviceTree&>(*standing.tree);
        const bool is_binary = tree.child_bits() == 1;
        for (const ColliderEntry& entry : box_colliders(true)) {
            const auto collider = entry.make(session().programs(), {});
            EXPECT_EQ(collider->refusal(*standing.tree).empty(),
                      is_binary || entry.name != "front-leaf")
                << entry.name << " over " << builder.name;
        }
    }
}

TEST(Colliders, ThatWantATreeOnTheDeviceRefuseOthers)
{
    const Standing standing(crowded_mesh(200), "median-split");
    expect_oracles_pairs(*made("brute"), standing);
    const auto leaf = made("leaf");
    EXPECT_NE(leaf->refusal(*standing.tree), "");
    EXPECT_THROW(leaf->reserve(standing.tree, standing.input), BadUsage);
}

TEST(Colliders, RefuseTreesWhoseLastLeafHasNoSuccessor)
{
    ImplicitTree tree;
    tree.leaves = tree.most_leaves = 1u << 31;
    for (const char* name : {"leaf", "group", "block", "bvtt"})
        EXPECT_EQ(made(name)->refusal(tree), std::string(name) +
                                                 " numbers nodes by 32 bits, for up to 2147483647 "
                                                 "leaves, not 2147483648");
    tree.leaves = tree.most_leaves = (1u << 31) - 1;
    EXPECT_EQ(made("block")->refusal(tree), "");
}

}  // namespace
}  // namespace bvhbench
