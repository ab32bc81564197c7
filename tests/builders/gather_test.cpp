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
        gather.enqueue(device_boxes, device_ids, sorted, before, bench().queue);
        bench().queue.finish();

        for (uint k = 0; k < size; ++k)
            expected[before + k] = boxes[ids[k]];
        EXPECT_TRUE(same_bits(sorted.download(queue), expected));
    }
}

INSTANTIATE_TEST_SUITE_P(Forms, GatherContract,
                         testing::Values(KernelForm::groups, KernelForm::chunks),
                         [](const auto& instance) { return form_name(instance.param); });

}  // namespace
}  // namespace bvhbench
