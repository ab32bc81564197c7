// SPDX-License-Identifier: MIT
#include "builders/stages/medians.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "builders/input.h"
#include "geometry/bounds.h"
#include "tests/builders/stage_testing.h"

namespace bvhbench {
namespace {

/// A buffer of its own with these values on the device.
template <class T>
Buffer<T> on_device(const std::vector<T>& values)
{
    Arena arena = Arena::reserved(bench().device, {values.size() * sizeof(T), 0});
    Buffer<T> buffer = arena.take<T>(values.size(), Use::tree);
    buffer.upload(bench().queue.cl(), values);
    return buffer;
}

std::vector<Aabb> boxes_of(const Mesh& mesh)
{
    std::vector<Aabb> boxes;
    for (const Face& face : mesh.faces)
        boxes.push_back(face_box(mesh.points, face));
    return boxes;
}

std::vector<uint> shuffled_ids(std::size_t count)
{
    std::vector<uint> ids(count);
    std::iota(ids.begin(), ids.end(), 0u);
    std::shuffle(ids.begin(), ids.end(), std::mt19937(3));
    return ids;
}

struct MedianCase {
    std::string name;
    MedianShape shape;
};

const MedianCase median_cases[] = {
    {"groups", {.form = KernelForm::groups}},
    {"groups_of_16_over_64", {.form = KernelForm::groups, .block_height = 6, .group_size = 16}},
    {"groups_of_16_over_16", {.form = KernelForm::groups, .block_height = 4, .group_size = 16}},
    {"chunks", {.form = KernelForm::chunks}},
    {"chunks_over_64", {.form = KernelForm::chunks, .block_height = 6}},
};

std::string case_name(const testing::TestParamInfo<MedianCase>& tested)
{
    return tested.param.name;
}

class BlockMediansContract : public testing::TestWithParam<MedianCase> {
protected:
    void expect_equal_to_host(const std::vector<Aabb>& boxes)
    {
        std::vector<uint> expected = shuffled_ids(boxes.size());
        const Buffer<Aabb> device_boxes = on_device(boxes);
        const Buffer<uint> ids = on_device(expected);
        BlockMedians medians(bench().programs, GetParam().shape);
        reserve([&](Arena& arena) { medians.plan(arena, boxes.size()); });
        bench().queue.begin("order");
        medians.enqueue(device_boxes, ids, bench().queue);
        bench().queue.finish();
        host_medians(boxes, expected, GetParam().shape.block_height);
        EXPECT_EQ(ids.download(bench().queue.cl()), expected);
    }
};

TEST_P(BlockMediansContract, EqualTheHostsOfFew)
{
    for (const std::size_t size : {1, 2, 3, 4, 5, 15, 16, 17, 63, 64, 65, 129})
        expect_equal_to_host(boxes_of(random_mesh(size, [](Point p) { return p; })));
}

TEST_P(BlockMediansContract, EqualTheHostsAroundWholeBlocks)
{
    for (const std::size_t size : {1023, 1024, 1025, 2047, 2048, 2049, 3000, 20'481})
        expect_equal_to_host(boxes_of(random_mesh(size, [](Point p) { return p; })));
}

TEST_P(BlockMediansContract, EqualTheHostsOnHardMeshes)
{
    for (const auto& [name, mesh] : hard_meshes(1500)) {
        SCOPED_TRACE(name);
        expect_equal_to_host(boxes_of(mesh));
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, BlockMediansContract, testing::ValuesIn(median_cases), case_name);

/// The definition itself, in words: at every split of the tree without pointers, all that went left comes
/// before all that went right along the widest axis, equals by id.
void expect_split(const std::vector<Aabb>& boxes, std::span<const uint> ids, uint height)
{
    if (height == 0 || ids.empty())
        return;
    const std::size_t left = std::min(ids.size(), std::size_t{1} << (height - 1));
    float low[3], high[3];
    std::fill_n(low, 3, std::numeric_limits<float>::max());
    std::fill_n(high, 3, std::numeric_limits<float>::lowest());
    const auto centre = [&](uint id, int axis) {
        const Point at = box_centre(boxes[id]);
        return axis == 0 ? at.x : axis == 1 ? at.y : at.z;
    };
    for (const uint id : ids)
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], centre(id, axis));
            high[axis] = std::max(high[axis], centre(id, axis));
        }
    int widest = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (high[axis] - low[axis] > high[widest] - low[widest])
            widest = axis;
    for (const uint a : ids.first(left))
        for (const uint b : ids.subspan(left))
            ASSERT_LT(std::pair(centre(a, widest), a), std::pair(centre(b, widest), b));
    expect_split(boxes, ids.first(left), height - 1);
    expect_split(boxes, ids.subspan(left), height - 1);
}

TEST(HostMedians, SplitEveryNodeAtItsMedian)
{
    for (const std::size_t size : {1, 2, 3, 7, 37, 64, 65}) {
        const std::vector<Aabb> boxes = boxes_of(random_mesh(size, [](Point p) {
            return Point{p.x, 0.5f * p.y, p.z};
        }));
        std::vector<uint> ids = shuffled_ids(size);
        host_medians(boxes, ids, 7);
        expect_split(boxes, ids, 7);
    }
}

}  // namespace
}  // namespace bvhbench
