// SPDX-License-Identifier: MIT
#include "builders/stages/bounds.h"

#include <cmath>

#include "tests/builders/stage_testing.h"

namespace bvhbench {
namespace {

class BoundsContract : public testing::TestWithParam<KernelForm> {
protected:
    /// Compares with the host. Without `objects` there is one object; `end`, if given, is a second frame to sweep to.
    void expect_equal_to_host(const Mesh& mesh, uint group_size,
                              const std::vector<FaceRange>& objects = {},
                              const std::vector<Point>& end = {})
    {
        Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces, objects);
        BoundsStage stage(bench().programs, GetParam(), group_size);
        reserve([&](Arena& arena) { stage.plan(arena, object_sizes(input), Use::tree, true); });
        stage.prepare(bench().queue.cl());
        // Runs again over cleared results: each launch must leave its state ready for the next. Then sweeps with the same
        // stage.
        expect_one(stage, input);
        Buffer<Bounds> found = stage.bounds();
        found.upload(bench().queue.cl(), std::vector(input.objects.size(), empty_bounds()));
        expect_one(stage, input);
        if (end.empty())
            return;
        upload_end(input, bench().device, bench().queue, end);
        EXPECT_FALSE(same_bits(leaf_boxes(input), face_boxes(mesh.points, mesh.faces)));
        expect_one(stage, input);
    }

private:
    static void expect_one(BoundsStage& stage, const Input& input)
    {
        stage.enqueue(input, bench().queue);
        bench().queue.finish();
        const std::vector<Aabb> boxes = leaf_boxes(input);
        EXPECT_TRUE(same_bits(from_device(stage.boxes()), boxes));
        std::vector<Bounds> each;
        for (const FaceRange& object : input.objects)
            each.push_back(host_bounds(std::span(boxes).subspan(object.first, object.count)));
        EXPECT_TRUE(same_bits(from_device(stage.bounds()), each));
        EXPECT_TRUE(same_bits(from_device(stage.bounds_of_all()), {host_bounds(boxes)}));
    }
};

TEST_P(BoundsContract, EqualTheHostsOnHardMeshes)
{
    for (const auto& [name, mesh] : hard_meshes(3000)) {
        SCOPED_TRACE(name);
        expect_equal_to_host(mesh, 64);
    }
}

// At most 16 groups of 16 on two cores, so sizes above 256 take several rounds.
TEST_P(BoundsContract, EqualTheHostsOfEverySize)
{
    const Mesh all = random_mesh(600);
    for (std::size_t size = 1; size <= all.faces.size(); ++size) {
        SCOPED_TRACE(size);
        Mesh mesh = all;
        mesh.faces.resize(size);
        expect_equal_to_host(mesh, 16);
    }
}

TEST_P(BoundsContract, EqualTheHostsOnTheWayBetweenTwoFrames)
{
    const Mesh mesh = random_mesh(1000);
    std::vector<Point> end = mesh.points;
    for (std::size_t k = 0; k < end.size(); ++k)
        end[k] = {end[k].y, k % 3 == 0 ? -0.0f : end[k].z + 0.25f, -end[k].x};
    expect_equal_to_host(mesh, 64, {}, end);
    expect_equal_to_host(mesh, 64, {{0, 1}, {1, 600}, {601, 399}}, end);
}

INSTANTIATE_TEST_SUITE_P(Forms, BoundsContract, testing::ValuesIn(both_forms), CaseName());

TEST(BoxCentre, NeitherOverflowsNorHasANegativeZero)
{
    constexpr float big = 3.4e38f;
    constexpr float tiny = std::numeric_limits<float>::denorm_min();
    const Point far = box_centre({big, -big, -big, big, big, -big});
    EXPECT_EQ(far.x, big);
    EXPECT_EQ(far.y, 0.0f);
    EXPECT_EQ(far.z, -big);
    const Point near = box_centre({-tiny, -tiny, tiny, -tiny, 0.0f, 3 * tiny});
    EXPECT_FALSE(std::signbit(near.x));
    EXPECT_FALSE(std::signbit(near.y));
    EXPECT_GT(near.z, 0.0f);
}

}  // namespace
}  // namespace bvhbench
