// SPDX-License-Identifier: MIT
//
// Compares the oracle with the counts of a separate program on real meshes.
#include <limits>

#include "collide/oracles/box_pairs.h"
#include "tests/collide/reference_testing.h"

namespace bvhbench {
namespace {

void expect_reference(const DataSetMesh& mesh, const nlohmann::json& reference)
{
    std::vector<Aabb> boxes;
    for (const Face& face : mesh.faces)
        boxes.push_back(face_box(mesh.points, face));
    const PairList all = overlapping_pairs(boxes);

    std::size_t counts[3] = {0, 0, 0};
    std::vector<Pair> not_adjacent;  // input of the reference hash
    for (const Pair pair : all.pairs()) {
        const Relation relation = relation_of(pair, {mesh.faces, mesh.objects});
        ++counts[static_cast<std::size_t>(relation)];
        if (relation != Relation::adjacent)
            not_adjacent.push_back(pair);
    }
    EXPECT_EQ(mesh.faces.size(), reference["tris"]);
    EXPECT_EQ(counts[0], reference["aabb_inter"]);
    EXPECT_EQ(counts[1], reference["aabb_self_nonadj"]);
    EXPECT_EQ(counts[2], reference["aabb_self_adjacent"]);
    EXPECT_EQ(hex(PairList(std::move(not_adjacent)).hash()), reference["aabb_hash"]);
}

TEST(Reference, StaticMeshesHaveThePairsTheReferenceCounted)
{
    if (data_folder().empty())
        GTEST_SKIP() << no_data_sets;
    compare_static_meshes(std::numeric_limits<std::size_t>::max(), expect_reference);
}

TEST(Reference, EveryFrameOfTheSequencesHasThePairsTheReferenceCounted)
{
    if (data_folder().empty())
        GTEST_SKIP() << no_data_sets;
    compare_frames([](const DataSetMesh& mesh, const nlohmann::json& reference, bool) {
        expect_reference(mesh, reference);
    });
}

}  // namespace
}  // namespace bvhbench
