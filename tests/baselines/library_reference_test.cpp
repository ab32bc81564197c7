// SPDX-License-Identifier: MIT
//
// Libraries' colliders find as many pairs as a separate program counted, and are listed even if they were not built.
#include "harness/measure/frames.h"
#include "tests/baselines/library_colliders.h"
#include "tests/collide/reference_testing.h"

namespace bvhbench {
namespace {

/// A separate program counted pairs with exact arithmetic on two frames each of a cloth and of 305 balls.
using LibraryReference = EachLibraryCollider;

TEST_P(LibraryReference, CountedWhatTheLibraryFinds)
{
    if (data_folder().empty())
        GTEST_SKIP() << no_data_sets;
    for (const char* name : {"unc_cloth_ball", "unc_nbody"}) {
        const std::filesystem::path folder = data_folder() / "dynamic" / name;
        const nlohmann::json meta = read_json(folder / "meta.json");
        const Scene scene = load_scene(folder.string(), {});
        const auto whole = made(Among::all), between = made(Among::between_objects);
        const std::string kind = whole->finds_contacts() ? "exact_" : "aabb_";
        for (std::size_t k = 0; k < scene.frames.size(); ++k) {
            SCOPED_TRACE(std::string(name) + ", frame " + std::to_string(k));
            const nlohmann::json& reference = meta["reference"][k];
            const Input input = upload_frame(session(), scene, k);
            if (k == 0) {
                whole->reserve(nullptr, input);
                between->reserve(nullptr, input);
            }
            const std::size_t pairs_between = reference[kind + "inter"];
            const std::size_t pairs_within = reference[kind + "self_nonadj"];
            const PairList found = found_by(*whole, input);
            EXPECT_EQ(found.size(), pairs_between + pairs_within);
            EXPECT_EQ(hex(found.hash()), reference[kind + "hash"]);
            EXPECT_EQ(found_by(*between, input).size(), pairs_between);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Libraries, LibraryReference, testing::ValuesIn(library_colliders),
                         CaseName());

TEST(LibraryColliders, AreListedAndRefusedWhereTheyWereNotBuilt)
{
    for (const char* name : library_colliders) {
        const ColliderEntry& entry = find_collider(name);
        if (entry.make != nullptr) {
            EXPECT_EQ(
                make_collider({{.keep_adjacent = false}, name}, session().programs())->card().name,
                name);
            continue;
        }
        EXPECT_TRUE(entry.absent.starts_with("built without ")) << entry.absent;
        EXPECT_THROW(make_collider({.name = name}, session().programs()), Unavailable);
    }
    EXPECT_THROW(make_collider({.name = "embre"}, session().programs()), BadUsage);
}

}  // namespace
}  // namespace bvhbench
