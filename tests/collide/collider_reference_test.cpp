// SPDX-License-Identifier: MIT
//
// Every collider against what a separate program counted on real meshes.
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

#include "geometry/hash.h"
#include "tests/collide/collider_testing.h"
#include "tests/collide/data_set.h"

namespace bvhbench {
namespace {

class ColliderReference : public testing::TestWithParam<std::tuple<ColliderEntry, KernelForm>> {};

std::unique_ptr<Collider> made(bool keep_adjacent)
{
    const auto& [entry, form] = ColliderReference::GetParam();
    return entry.make(session().programs(), {.keep_adjacent = keep_adjacent, .form = form});
}

PairList pairs_found(const Standing& standing, bool keep_adjacent)
{
    const auto collider = made(keep_adjacent);
    collider->reserve(standing.tree, standing.input);
    find_pairs(*collider, standing.tree, standing.input, session().queue());
    PairList found(collider->pairs(session().queue()));
    session().queue().finish();
    EXPECT_EQ(found.surplus(), 0u);
    return found;
}

TEST_P(ColliderReference, CountedThePairsThatTheColliderFinds)
{
    const char* data = std::getenv("BVHBENCH_DATA");
    if (data == nullptr || *data == '\0')
        GTEST_SKIP() << "BVHBENCH_DATA is not set: nothing is compared with the data sets";
    const std::filesystem::path folder = std::filesystem::path(data) / "static";
    std::ifstream in(folder / "reference.json");
    const nlohmann::json references = nlohmann::json::parse(in);
    for (const char* name : {"bunny_69451.ply", "armadillo_86482.ply"}) {
        const DataSetMesh file = read_data_set_mesh(folder / name);
        const nlohmann::json& reference = references[name];
        for (const char* builder : {"oibvh-multi", "lbvh-levels"}) {
            SCOPED_TRACE(std::string(name) + ", " + builder);
            const Standing standing({file.points, file.faces}, find_builder(builder).make);
            if (!takes(*made(true), standing)) {
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
                         testing::Combine(testing::ValuesIn(box_colliders(false)),
                                          testing::Values(KernelForm::groups, KernelForm::chunks)),
                         [](const auto& tested) {
                             return test_name(std::string(std::get<0>(tested.param).name)) + '_' +
                                    (std::get<1>(tested.param) == KernelForm::groups ? "groups"
                                                                                     : "chunks");
                         });

}  // namespace
}  // namespace bvhbench
