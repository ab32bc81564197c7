// SPDX-License-Identifier: MIT
#include "builders/stages/gather.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/builders/stage_testing.h"

namespace bvhbench {
namespace {

class GatherContract : public testing::TestWithParam<KernelForm> {};

TEST_P(GatherContract, FillsItsPlaceInTheOrderOfTheIdsAndNothingElse)
{
    constexpr uint before = 7;
    constexpr uint after = 5;
    const cl::CommandQueue& queue = bench().queue.cl();
    GatherStage gather(bench().programs, GetParam(), 16);
    for (uint size = 0; size <= 100; ++size) {
        SCOPED_TRACE(size);
        std::vector<Aabb> boxes;
        for (uint k = 0; k < size; ++k) {
            const auto at = static_cast<float>(k);
            boxes.push_back({at, at + 0.1f, at + 0.2f, at + 0.3f, at + 0.4f, at + 0.5f});
        }
        std::vector<uint> ids(size);
        std::iota(ids.begin(), ids.end(), 0u);
        std::shuffle(ids.begin(), ids.end(), std::mt19937(size));
        std::vector<Aabb> expected(before + size + after, empty_box());

        Buffer<Aabb> device_boxes, sorted;
        Buffer<uint> device_ids;
        reserve([&](Arena& arena) {
            device_boxes = arena.take<Aabb>(size, Use::scratch);
            device_ids = arena.take<uint>(size, Use::scratch);
            sorted = arena.take<Aabb>(expected.size(), Use::scratch);
        });
        device_boxes.upload(queue, boxes);
        device_ids.upload(queue, ids);
        sorted.upload(queue, expected);
        gather.enqueue(device_boxes, device_ids, sorted.as<std::byte>(), before, bench().queue);
        bench().queue.finish();

        for (uint k = 0; k < size; ++k)
            expected[before + k] = boxes[ids[k]];
        EXPECT_TRUE(same_bits(sorted.download(queue), expected));
    }
}

/// The runs of some objects, whose slots are in another order than they are.
TEST_P(GatherContract, FillsThePlacesOfChosenObjectsAndNoOthers)
{
    const cl::CommandQueue& queue = bench().queue.cl();
    GatherStage gather(bench().programs, GetParam(), 16);
    ObjectRuns runs(bench().device, GetParam(), 16);
    const std::vector<uint> sizes = {3, 200, 1, 70}, firsts = {0, 3, 203, 204};
    const std::vector<uint> roots = {210, 0, 215, 220};  // each object's first slot
    std::vector<uint> slots, ids;
    for (std::size_t k = 0; k < sizes.size(); ++k) {
        slots.push_back(roots[k] - firsts[k]);
        for (uint id = sizes[k]; id > 0; --id)
            ids.push_back(firsts[k] + id - 1);
    }
    std::vector<Aabb> boxes;
    for (std::size_t k = 0; k < ids.size(); ++k) {
        const auto at = static_cast<float>(k);
        boxes.push_back({at, at + 0.1f, at + 0.2f, at + 0.3f, at + 0.4f, at + 0.5f});
    }
    std::vector<Aabb> expected(300, empty_box());
    Buffer<Aabb> device_boxes, sorted;
    Buffer<uint> device_ids, device_slots;
    reserve([&](Arena& arena) {
        device_boxes = arena.take<Aabb>(boxes.size(), Use::scratch);
        device_ids = arena.take<uint>(ids.size(), Use::scratch);
        device_slots = arena.take<uint>(slots.size(), Use::scratch);
        sorted = arena.take<Aabb>(expected.size(), Use::scratch);
        runs.plan(arena, sizes);
    });
    device_boxes.upload(queue, boxes);
    device_ids.upload(queue, ids);
    device_slots.upload(queue, slots);
    for (const std::vector<uint>& chosen : {std::vector<uint>{1}, {0, 2}, {3}, {0, 1, 2, 3}}) {
        sorted.upload(queue, std::vector<Aabb>(expected.size(), empty_box()));
        expected.assign(expected.size(), empty_box());
        runs.choose(queue, {}, chosen);
        gather.enqueue(device_boxes, device_ids, runs, device_slots, sorted.as<std::byte>(),
                       bench().queue);
        bench().queue.finish();
        for (const uint object : chosen)
            for (uint k = 0; k < sizes[object]; ++k)
                expected[roots[object] + k] = boxes[ids[firsts[object] + k]];
        EXPECT_TRUE(same_bits(sorted.download(queue), expected));
    }
}

INSTANTIATE_TEST_SUITE_P(Forms, GatherContract,
                         testing::Values(KernelForm::groups, KernelForm::chunks),
                         [](const auto& instance) { return form_name(instance.param); });

}  // namespace
}  // namespace bvhbench
