// SPDX-License-Identifier: MIT
#include "builders/stages/bounds.h"

#include <gtest/gtest.h>

#include <cmath>

#include "builders/stages/object_bounds.h"
#include "tests/builders/stage_testing.h"

namespace bvhbench {
namespace {

class BoundsContract : public testing::TestWithParam<KernelForm> {
protected:
    void expect_equal_to_host(const Mesh& mesh, uint group_size)
    {
        BoundsStage stage(bench().programs, GetParam(), group_size);
        reserve([&](Arena& arena) { stage.plan(arena, mesh.faces.size(), Use::tree); });
        stage.prepare(bench().queue.cl());
        const Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces);
        // Twice, the second time without the first one's result: each launch must leave all ready for the next.
        stage.enqueue(input, bench().queue);
        const Bounds none = empty_bounds();
        Buffer<Bounds> found = stage.bounds();
        found.upload(bench().queue.cl(), {&none, 1});
        stage.enqueue(input, bench().queue);
        bench().queue.finish();

        std::vector<Aabb> boxes;
        for (const Face face : mesh.faces)
            boxes.push_back(face_box(mesh.points, face));
        EXPECT_TRUE(same_bits(stage.boxes().download(bench().queue.cl()), boxes));
        EXPECT_TRUE(same_bits(stage.bounds().download(bench().queue.cl()), {host_bounds(boxes)}));
    }
};

TEST_P(BoundsContract, EqualTheHostsOnHardMeshes)
{
    for (const auto& [name, mesh] : hard_meshes(3000)) {
        SCOPED_TRACE(name);
        expect_equal_to_host(mesh, 64);
    }
}

// 16 groups of 16 at most on two cores: sizes past 256 take several rounds.
TEST_P(BoundsContract, EqualTheHostsOfEverySize)
{
    const Mesh all = random_mesh(600, [](Point p) { return p; });
    for (std::size_t size = 1; size <= all.faces.size(); ++size) {
        SCOPED_TRACE(size);
        Mesh mesh = all;
        mesh.faces.resize(size);
        expect_equal_to_host(mesh, 16);
    }
}

TEST_P(BoundsContract, EqualTheHostsOnTheWayBetweenTwoFrames)
{
    const Mesh mesh = random_mesh(1000, [](Point p) { return p; });
    std::vector<Point> end = mesh.points;
    for (std::size_t k = 0; k < end.size(); ++k)
        end[k] = {end[k].y, k % 3 == 0 ? -0.0f : end[k].z + 0.25f, -end[k].x};
    const std::vector<FaceRange> objects = {{0, 1}, {1, 600}, {601, 399}};
    Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces, objects);
    BoundsStage stage(bench().programs, GetParam(), 64);
    ObjectBounds by_object(bench().programs, GetParam(), 64);
    reserve([&](Arena& arena) {
        stage.plan(arena, mesh.faces.size(), Use::tree);
        by_object.plan(arena, object_sizes(input), Use::tree);
    });
    stage.prepare(bench().queue.cl());
    by_object.prepare(bench().queue.cl());
    for (const bool swept : {false, true}) {  // one stage makes both
        SCOPED_TRACE(swept);
        if (swept)
            upload_end(input, bench().device, bench().queue, end);
        stage.enqueue(input, bench().queue);
        by_object.enqueue(input, bench().queue);
        bench().queue.finish();
        const std::vector<Aabb> boxes = leaf_boxes(input);
        EXPECT_EQ(same_bits(boxes, face_boxes(mesh.points, mesh.faces)), !swept);
        EXPECT_TRUE(same_bits(stage.boxes().download(bench().queue.cl()), boxes));
        EXPECT_TRUE(same_bits(by_object.boxes().download(bench().queue.cl()), boxes));
        EXPECT_TRUE(same_bits(stage.bounds().download(bench().queue.cl()), {host_bounds(boxes)}));
        std::vector<Bounds> each;
        for (const FaceRange& object : objects)
            each.push_back(host_bounds(std::span(boxes).subspan(object.first, object.count)));
        EXPECT_TRUE(same_bits(by_object.bounds().download(bench().queue.cl()), each));
    }
}

INSTANTIATE_TEST_SUITE_P(Forms, BoundsContract,
                         testing::Values(KernelForm::groups, KernelForm::chunks),
                         [](const auto& instance) { return form_name(instance.param); });

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
