// SPDX-License-Identifier: MIT
#include "builders/stages/codes.h"

#include "builders/orders.h"
#include "builders/stages/bounds.h"
#include "builders/stages/sort/waiting_sort.h"
#include "tests/builders/stage_testing.h"

namespace bvhbench {
namespace {

struct Scene {
    std::vector<Aabb> boxes;
    std::vector<Bounds> bounds;  ///< Of each object.
    std::vector<uint> owners;
};

/// Returns `count` boxes in `objects` objects of equal size, but for the last.
Scene boxes_of(uint count, uint objects)
{
    const Mesh mesh = random_mesh(count);
    Scene scene{.boxes = face_boxes(mesh.points, mesh.faces), .bounds = {}, .owners = {}};
    const uint each = count / objects;
    for (uint k = 0; k < objects; ++k) {
        const uint end = k + 1 < objects ? each * (k + 1) : count;
        scene.bounds.push_back(
            host_bounds(std::span(scene.boxes).subspan(each * k, end - each * k)));
        scene.owners.resize(end, k);
    }
    return scene;
}

// The object's number leaves room in three passes, or in the word.
static_assert(kept_code_bits(24, 1) == 24 && kept_code_bits(24, 305) == 15);
static_assert(kept_code_bits(24, std::size_t{1} << 25) == 7 && kept_code_bits(30, 305) == 23);

class CodesContract : public testing::TestWithParam<OrderEntry> {
protected:
    /// Codes by groups, alone and with counts of their digits, are those of the host. A work-item makes several of them.
    static void expect_equal_to_host(const Scene& scene)
    {
        const OrderEntry& order = GetParam();
        const std::size_t count = scene.boxes.size(), objects = scene.bounds.size();
        const uint words = code_words(order.code_bits),
                   kept = kept_code_bits(order.code_bits, objects);
        const uint bits = kept + ceil_log2(static_cast<uint>(objects));
        CodesStage stage(bench().programs, order, KernelForm::groups, objects);
        stage.plan_counting();

        std::vector<uint> expected, counts(std::size_t{most_tile_passes} << tile_digit_bits);
        for (std::size_t k = 0; k < count; ++k) {
            const uint owner = scene.owners[k];
            const ulong code =
                (objects > 1 ? ulong{owner} << kept : 0) |
                order.code(scene.boxes[k], scene.bounds[owner]) >> (order.code_bits - kept);
            for (uint word = 0; word < words; ++word)
                expected.push_back(static_cast<uint>(code >> 32 * word));
            for (uint pass = 0; pass < divided_up(bits, tile_digit_bits); ++pass)
                ++counts[(pass << tile_digit_bits) + (code >> tile_digit_bits * pass & 255)];
        }

        const Buffer<Aabb> boxes = on_device(scene.boxes);
        const Buffer<Bounds> bounds = on_device(scene.bounds);
        const Buffer<uint> owners = on_device(scene.owners);
        const Buffer<uint> alone = on_device(std::vector<uint>(words * count, 7));
        const Buffer<uint> counted = on_device(std::vector<uint>(words * count, 7));
        const Buffer<uint> counters = on_device(std::vector<uint>(counts.size()));
        stage.enqueue(boxes, bounds, owners, alone, bench().queue);
        stage.enqueue_counted(boxes, bounds, owners, counted, counters, bits, bench().queue);
        bench().queue.finish();
        EXPECT_EQ(from_device(alone), expected);
        EXPECT_EQ(from_device(counted), expected);
        EXPECT_EQ(from_device(counters), counts);
    }
};

TEST_P(CodesContract, EqualTheHosts)
{
    for (const uint count : {1u, 513u, 20'001u}) {
        SCOPED_TRACE(count);
        expect_equal_to_host(boxes_of(count, 1));
    }
    expect_equal_to_host(boxes_of(5'003, 5));
}

INSTANTIATE_TEST_SUITE_P(Orders, CodesContract, testing::ValuesIn([] {
                             std::vector<OrderEntry> orders;
                             for (const OrderEntry& order : order_catalog())
                                 if (order.code_bits > 0 && order.medians == Medians::nowhere)
                                     orders.push_back(order);
                             return orders;
                         }()),
                         CaseName());

}  // namespace
}  // namespace bvhbench
