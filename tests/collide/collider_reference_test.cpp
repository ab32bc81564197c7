// SPDX-License-Identifier: MIT
//
// Compares every collider with the counts of a separate program on real meshes.
#include "tests/collide/collider_testing.h"
#include "tests/collide/reference_testing.h"

namespace bvhbench {
namespace {

class ColliderReference : public testing::TestWithParam<std::tuple<ColliderEntry, KernelForm>> {};

std::unique_ptr<Collider> tested(bool keep_adjacent)
{
    const auto& [entry, form] = ColliderReference::GetParam();
    return made(entry.name, {.keep_adjacent = keep_adjacent, .form = form});
}

PairList pairs_found(const Standing& standing, bool keep_adjacent)
{
    const auto collider = tested(keep_adjacent);
    collider->reserve(standing.tree, standing.input);
    find_pairs(*collider, standing.tree, standing.input, session().queue());
    PairList found(collider->pairs(session().queue()));
    session().queue().finish();
    EXPECT_EQ(found.surplus(), 0u);
    return found;
}

TEST_P(ColliderReference, CountedThePairsThatTheColliderFinds)
{
    if (data_sets().empty())
        GTEST_SKIP() << no_data_sets;
    const std::filesystem::path folder = data_sets() / "static";
    const nlohmann::json references = read_json(folder / "reference.json");
    for (const char* name : {"bunny_69451.ply", "armadillo_86482.ply"}) {
        const DataSetMesh file = read_data_set_mesh(folder / name);
        const nlohmann::json& reference = references[name];
        for (const char* builder : {"oibvh-multi", "lbvh-levels"}) {
            SCOPED_TRACE(std::string(name) + ", " + builder);
            const Standing standing({file.points, file.faces}, builder);
            if (!takes(*tested(true), standing)) {
                EXPECT_EQ(builder, std::string("lbvh-levels"));
                continue;
            }
            const std::size_t apart = reference["aabb_self_nonadj"];
            const std::size_t adjacent = reference["aabb_self_adjacent"];
            EXPECT_EQ(pairs_found(standing, true).size(), apart + adjacent);
            const PairList found = pairs_found(standing, false);
            EXPECT_EQ(found.size(), apart);
            EXPECT_EQ(hex(found.hash()), reference["aabb_hash"]);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Catalog, ColliderReference,
                         testing::Combine(testing::ValuesIn(box_colliders(false)), both_forms),
                         CaseName());

}  // namespace
}  // namespace bvhbench
