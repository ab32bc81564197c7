// SPDX-License-Identifier: MIT
#include "builders/stages/medians/medians.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <ranges>

#include "builders/input.h"
#include "builders/stages/medians/cells.h"
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
    {"groups_of_32_over_64", {.form = KernelForm::groups, .block_height = 6, .group_size = 32}},
    {"groups_of_32_over_32", {.form = KernelForm::groups, .block_height = 5, .group_size = 32}},
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
        host_block_medians(boxes, expected, GetParam().shape.block_height);
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

/// Cells above blocks: what is in which block is equal to the host's, in whatever order.
class CellMediansContract : public testing::TestWithParam<MedianCase> {
protected:
    void expect_equal_to_host(const std::vector<Aabb>& boxes)
    {
        Bounds bounds = empty_bounds();
        for (const Aabb& box : boxes)
            bounds = grown(bounds, box);
        const Buffer<Aabb> device_boxes = on_device(boxes);
        const Buffer<Bounds> device_bounds = on_device(std::vector<Bounds>{bounds});
        const Buffer<uint> ids = on_device(std::vector<uint>(boxes.size(), ~0u));
        CellMedians medians(bench().programs, GetParam().shape);
        reserve([&](Arena& arena) { medians.plan(arena, boxes.size()); });
        std::vector<uint> expected(boxes.size());
        std::iota(expected.begin(), expected.end(), 0u);
        host_cell_medians(boxes, expected, GetParam().shape.block_height);
        sort_blocks(expected);
        for (int repeat = 0; repeat < 2; ++repeat) {
            bench().queue.begin("order");
            medians.enqueue(device_boxes, device_bounds, ids, bench().queue);
            bench().queue.finish();
            std::vector<uint> found = ids.download(bench().queue.cl());
            sort_blocks(found);
            ASSERT_EQ(found, expected);
        }
    }

private:
    static void sort_blocks(std::vector<uint>& ids)
    {
        const std::size_t block = std::size_t{1} << GetParam().shape.block_height;
        for (std::size_t first = 0; first < ids.size(); first += block)
            std::sort(
                ids.begin() + static_cast<std::ptrdiff_t>(first),
                ids.begin() + static_cast<std::ptrdiff_t>(std::min(ids.size(), first + block)));
    }
};

TEST_P(CellMediansContract, EqualTheHostsOfFew)
{
    for (const std::size_t size : {1, 2, 3, 33, 63, 64, 65, 127, 128, 129, 193})
        expect_equal_to_host(boxes_of(random_mesh(size, [](Point p) { return p; })));
}

TEST_P(CellMediansContract, EqualTheHostsAroundWholeBlocks)
{
    for (const std::size_t size : {1024, 1025, 2047, 2048, 2049, 3000, 40'000})
        expect_equal_to_host(boxes_of(random_mesh(size, [](Point p) { return p; })));
}

TEST_P(CellMediansContract, EqualTheHostsOnHardMeshes)
{
    for (const auto& [name, mesh] : hard_meshes(3000)) {
        SCOPED_TRACE(name);
        expect_equal_to_host(boxes_of(mesh));
    }
}

/// Most centres near the middle: the slab of a median holds more than what is compared each with all.
TEST_P(CellMediansContract, EqualTheHostsOfClusters)
{
    const auto drawn_in = [](float x) { return x * x * x * x * x; };
    expect_equal_to_host(boxes_of(random_mesh(20'000, [&](Point p) {
        return Point{drawn_in(p.x), drawn_in(p.y), drawn_in(p.z)};
    })));
}

const MedianCase cell_cases[] = {
    {"groups", {.form = KernelForm::groups}},
    {"groups_over_32", {.form = KernelForm::groups, .block_height = 5}},
    {"chunks", {.form = KernelForm::chunks}},
    {"chunks_over_32", {.form = KernelForm::chunks, .block_height = 5}},
};

INSTANTIATE_TEST_SUITE_P(Shapes, CellMediansContract, testing::ValuesIn(cell_cases), case_name);

float centre_along(const Aabb& box, uint axis) { return coordinate(box_centre(box), axis); }

/// Half the surface of the box around the centres, times their number.
double cost(const std::vector<Aabb>& boxes, std::span<const uint> ids)
{
    double sides[3];
    for (uint axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::ranges::minmax(
            ids | std::views::transform([&](uint id) { return centre_along(boxes[id], axis); }));
        sides[axis] = double{high} - low;
    }
    return (sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0]) *
           static_cast<double>(ids.size());
}

/// The definition itself, in words: at every split of the tree without pointers, all that went left comes
/// before all that went right along some axis, equals by id, and along no other would the halves cost less.
void expect_split(const std::vector<Aabb>& boxes, std::span<const uint> ids, uint height)
{
    if (height == 0 || ids.empty())
        return;
    const std::size_t left = std::min(ids.size(), std::size_t{1} << (height - 1));
    if (left < ids.size()) {
        const double chosen = cost(boxes, ids.first(left)) + cost(boxes, ids.subspan(left));
        bool is_split = false;
        for (uint axis = 0; axis < 3; ++axis) {
            std::vector<uint> sorted(ids.begin(), ids.end());
            std::ranges::sort(
                sorted, {}, [&](uint id) { return std::pair(centre_along(boxes[id], axis), id); });
            const std::span<const uint> all = sorted;
            EXPECT_LE(chosen,
                      (cost(boxes, all.first(left)) + cost(boxes, all.subspan(left))) * 1.000001);
            is_split = is_split || std::is_permutation(ids.begin(), ids.begin() + left, all.begin(),
                                                       all.begin() + left);
        }
        EXPECT_TRUE(is_split);
    }
    expect_split(boxes, ids.first(left), height - 1);
    expect_split(boxes, ids.subspan(left), height - 1);
}

TEST(HostMedians, SplitEveryNodeAtTheCheapestMedian)
{
    for (const std::size_t size : {1, 2, 3, 7, 37, 64, 65}) {
        const std::vector<Aabb> boxes = boxes_of(random_mesh(size, [](Point p) {
            return Point{p.x, 0.5f * p.y, p.z};
        }));
        std::vector<uint> ids = shuffled_ids(size);
        host_block_medians(boxes, ids, 7);
        expect_split(boxes, ids, 7);
    }
}

}  // namespace
}  // namespace bvhbench
