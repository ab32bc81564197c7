// SPDX-License-Identifier: MIT
#include "builders/stages/gather.h"

#include "tests/builders/stage_testing.h"

namespace bvhbench {
namespace {

/// Returns boxes that are all different.
std::vector<Aabb> numbered_boxes(std::size_t count)
{
    std::vector<Aabb> boxes;
    for (std::size_t k = 0; k < count; ++k) {
        const auto at = static_cast<float>(k);
        boxes.push_back({at, at + 0.1f, at + 0.2f, at + 0.3f, at + 0.4f, at + 0.5f});
    }
    return boxes;
}

class GatherContract : public testing::TestWithParam<KernelForm> {
protected:
    GatherContract() : gather_(bench().programs, GetParam(), 16) {}

    void plan(std::size_t size, uint first, const Buffer<uint>& slots = {})
    {
        sorted_ = on_device(std::vector<Aabb>(size, empty_box()));
        reserve([&](Arena& arena) {
            gather_.plan(arena, {sorted_.as<std::byte>(), first, slots});
        });
    }

    void expect(const std::vector<Aabb>& expected)
    {
        bench().queue.finish();
        EXPECT_TRUE(same_bits(from_device(sorted_), expected));
    }

    GatherStage gather_;
    Buffer<Aabb> sorted_;
};

TEST_P(GatherContract, FillsItsPlaceInTheOrderOfTheIdsAndNothingElse)
{
    constexpr uint before = 7, after = 5;
    for (uint size = 0; size <= 100; ++size) {
        SCOPED_TRACE(size);
        const std::vector<Aabb> boxes = numbered_boxes(size);
        const std::vector<uint> ids = shuffled_ids(size);
        std::vector<Aabb> expected(before + size + after, empty_box());
        for (uint k = 0; k < size; ++k)
            expected[before + k] = boxes[ids[k]];
        plan(expected.size(), before);
        gather_.enqueue(on_device(boxes), on_device(ids), {}, bench().queue);
        expect(expected);
    }
}

/// Gathers all objects, and ranges of some objects whose slots are in a different order than the objects.
TEST_P(GatherContract, FillsThePlacesOfChosenObjectsAndNoOthers)
{
    ObjectRuns runs(bench().device, GetParam(), 16);
    const std::vector<uint> sizes = {3, 200, 1, 70}, firsts = {0, 3, 203, 204};
    const std::vector<uint> roots = {210, 0, 215, 220};  // each object's first slot
    std::vector<uint> slots, ids, owners;
    for (uint k = 0; k < sizes.size(); ++k) {
        slots.push_back(roots[k] - firsts[k]);
        owners.insert(owners.end(), sizes[k], k);
        for (uint id = sizes[k]; id > 0; --id)
            ids.push_back(firsts[k] + id - 1);
    }
    const std::vector<Aabb> boxes = numbered_boxes(ids.size());
    const Buffer<Aabb> device_boxes = on_device(boxes);
    const Buffer<uint> device_ids = on_device(ids), device_owners = on_device(owners);
    reserve([&](Arena& arena) { runs.plan(arena, sizes); });
    const std::vector<uint> all = {0, 1, 2, 3};
    for (const std::vector<uint>& chosen : {std::vector<uint>{1}, {0, 2}, {3}, all}) {
        std::vector<Aabb> expected(300, empty_box());
        for (const uint object : chosen)
            for (uint k = 0; k < sizes[object]; ++k)
                expected[roots[object] + k] = boxes[ids[firsts[object] + k]];
        plan(expected.size(), 0, on_device(slots));
        runs.choose(bench().queue.cl(), {}, chosen);
        gather_.enqueue(device_boxes, device_ids, runs, bench().queue);
        expect(expected);
        if (chosen != all)
            continue;
        plan(expected.size(), 0, on_device(slots));
        gather_.enqueue(device_boxes, device_ids, device_owners, bench().queue);
        expect(expected);
    }
}

INSTANTIATE_TEST_SUITE_P(Forms, GatherContract, testing::ValuesIn(both_forms), CaseName());

}  // namespace
}  // namespace bvhbench
