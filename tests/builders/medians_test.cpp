// SPDX-License-Identifier: MIT
#include "builders/stages/medians/medians.h"

#include <ranges>

#include "builders/stages/bounds.h"
#include "builders/stages/medians/cells.h"
#include "tests/builders/stage_testing.h"

namespace bvhbench {
namespace {

std::vector<Aabb> boxes_of(const Mesh& mesh) { return face_boxes(mesh.points, mesh.faces); }

/// Compares kernels of both kinds with the host: medians within blocks, or medians by cells above the blocks, for which each
/// block must hold the same leaves as on the host, in any order.
struct MedianCase {
    std::string name;
    bool is_of_cells;
    MedianShape shape;
};

constexpr KernelForm groups = KernelForm::groups, chunks = KernelForm::chunks;
const MedianCase cases[] = {
    {"blocks_groups", false, {.form = groups}},
    {"blocks_groups_of_32_over_64", false, {.form = groups, .block_height = 6, .group_size = 32}},
    {"blocks_groups_of_32_over_32", false, {.form = groups, .block_height = 5, .group_size = 32}},
    {"blocks_chunks", false, {.form = chunks}},
    {"blocks_chunks_over_64", false, {.form = chunks, .block_height = 6}},
    {"cells_groups", true, {.form = groups}},
    {"cells_groups_over_32", true, {.form = groups, .block_height = 5, .group_size = 32}},
    {"cells_chunks", true, {.form = chunks}},
    {"cells_chunks_over_32", true, {.form = chunks, .block_height = 5}},
};

class MediansContract : public testing::TestWithParam<MedianCase> {
protected:
    void expect_equal_to_host(const std::vector<Aabb>& boxes)
    {
        const Buffer<Aabb> device_boxes = on_device(boxes);
        std::vector<uint> expected = shuffled_ids(boxes.size());
        const Buffer<uint> ids = on_device(expected);
        if (GetParam().is_of_cells)
            expect_cells(boxes, device_boxes, ids);
        else
            expect_blocks(boxes, device_boxes, ids, expected);
    }

private:
    static void expect_blocks(const std::vector<Aabb>& boxes, const Buffer<Aabb>& device_boxes,
                              const Buffer<uint>& ids, std::vector<uint> expected)
    {
        BlockMedians medians(bench().programs, GetParam().shape);
        bench().queue.begin("order");
        medians.enqueue(device_boxes, ids, bench().queue);
        bench().queue.finish();
        host_block_medians(boxes, expected, GetParam().shape.block_height);
        EXPECT_EQ(from_device(ids), expected);
    }

    static void expect_cells(const std::vector<Aabb>& boxes, const Buffer<Aabb>& device_boxes,
                             const Buffer<uint>& ids)
    {
        const Buffer<Bounds> bounds = on_device(std::vector<Bounds>{host_bounds(boxes)});
        CellMedians medians(bench().programs, GetParam().shape);
        reserve([&](Arena& arena) { medians.plan(arena, boxes.size()); });
        std::vector<uint> expected(boxes.size());
        std::iota(expected.begin(), expected.end(), 0u);
        host_cell_medians(boxes, expected, GetParam().shape.block_height);
        for (int repeat = 0; repeat < 2; ++repeat) {
            bench().queue.begin("order");
            medians.enqueue(device_boxes, bounds, ids, bench().queue);
            bench().queue.finish();
            ASSERT_EQ(with_sorted_blocks(from_device(ids)), with_sorted_blocks(expected));
        }
    }

    static std::vector<uint> with_sorted_blocks(std::vector<uint> ids)
    {
        const std::size_t block = std::size_t{1} << GetParam().shape.block_height;
        for (std::size_t first = 0; first < ids.size(); first += block)
            std::ranges::sort(std::span(ids).subspan(first, std::min(block, ids.size() - first)));
        return ids;
    }
};

TEST_P(MediansContract, EqualTheHostsOfFew)
{
    for (const std::size_t size : {1, 2, 3, 4, 5, 15, 16, 17, 33, 63, 64, 65, 127, 128, 129, 193})
        expect_equal_to_host(boxes_of(random_mesh(size)));
}

TEST_P(MediansContract, EqualTheHostsAroundWholeBlocks)
{
    for (const std::size_t size :
         {1023, 1024, 1025, 2047, 2048, 2049, 3000, GetParam().is_of_cells ? 40'000 : 20'481})
        expect_equal_to_host(boxes_of(random_mesh(size)));
}

TEST_P(MediansContract, EqualTheHostsOnHardMeshes)
{
    for (const auto& [name, mesh] : hard_meshes(GetParam().is_of_cells ? 3000 : 1500)) {
        SCOPED_TRACE(name);
        expect_equal_to_host(boxes_of(mesh));
    }
}

/// There are enough leaves for several work-items of the form `chunks` to split their subtrees at the same time.
TEST_P(MediansContract, EqualTheHostsOfMany)
{
    expect_equal_to_host(
        boxes_of(random_mesh(GetParam().shape.form == KernelForm::chunks ? 300'000 : 50'000)));
}

/// Most centres lie near the middle, so the slab of a median holds more boxes than the kernel compares pairwise.
TEST_P(MediansContract, EqualTheHostsOfClusters)
{
    const auto drawn_in = [](float x) { return x * x * x * x * x; };
    expect_equal_to_host(boxes_of(random_mesh(20'000, [&](Point p) {
        return Point{drawn_in(p.x), drawn_in(p.y), drawn_in(p.z)};
    })));
}

INSTANTIATE_TEST_SUITE_P(Shapes, MediansContract, testing::ValuesIn(cases), CaseName());

float centre_along(const Aabb& box, uint axis) { return coordinate(box_centre(box), axis); }

/// Returns half the surface of the box around the centres, times their number.
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

/// Checks the definition: at every split of the tree without pointers, the left boxes come before all right boxes along some
/// axis, ties broken by id, and no other axis gives a smaller cost of the halves.
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
