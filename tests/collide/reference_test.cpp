// SPDX-License-Identifier: MIT
//
// The oracle against what a separate program counted on real meshes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

#include "collide/oracles/sweep.h"
#include "collide/relation.h"
#include "geometry/hash.h"
#include "geometry/mesh.h"
#include "tests/collide/data_set.h"

namespace bvhbench {
namespace {

class Reference : public testing::Test {
protected:
    void SetUp() override
    {
        const char* data = std::getenv("BVHBENCH_DATA");
        if (data == nullptr || *data == '\0')
            GTEST_SKIP() << "BVHBENCH_DATA is not set: nothing is compared with the data sets";
        data_ = data;
    }

    std::filesystem::path data_;
};

nlohmann::json read_json(const std::filesystem::path& path)
{
    std::ifstream in(path);
    return nlohmann::json::parse(in);
}

void expect_reference(std::span<const Point> points, const DataSetMesh& mesh,
                      const nlohmann::json& reference)
{
    std::vector<Aabb> boxes;
    for (const Face& face : mesh.faces)
        boxes.push_back(face_box(points, face));
    const PairList all = overlapping_pairs(boxes);

    std::size_t counts[3] = {0, 0, 0};
    std::vector<Pair> not_adjacent;  // what the reference hash is over
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

TEST_F(Reference, StaticMeshesHaveThePairsTheReferenceCounted)
{
    std::size_t compared = 0;
    const nlohmann::json references = read_json(data_ / "static/reference.json");
    for (const auto& [name, reference] : references.items()) {
        SCOPED_TRACE(name);
        const std::filesystem::path path = data_ / "static" / name;
        if (!std::filesystem::exists(path)) {
            std::cout << "not there, not compared: " << name << '\n';
            continue;
        }
        const DataSetMesh mesh = read_data_set_mesh(path);
        expect_reference(mesh.points, mesh, reference);
        ++compared;
    }
    EXPECT_GT(compared, 0u);
}

TEST_F(Reference, EveryFrameOfTheSequencesHasThePairsTheReferenceCounted)
{
    std::size_t compared = 0;
    for (const auto& entry : std::filesystem::directory_iterator(data_ / "dynamic")) {
        SCOPED_TRACE(entry.path().filename().string());
        const nlohmann::json meta = read_json(entry.path() / "meta.json");
        const DataSetMesh mesh = read_data_set_mesh(entry.path() / "mesh.ply");
        const auto frames =
            read_frames(entry.path() / "frames.f32", meta["frames"], mesh.points.size());
        for (const nlohmann::json& reference : meta["reference"]) {
            SCOPED_TRACE("frame " + reference["index"].dump());
            expect_reference(frames.at(reference["index"]), mesh, reference);
            ++compared;
        }
    }
    EXPECT_GT(compared, 0u);
}

}  // namespace
}  // namespace bvhbench
