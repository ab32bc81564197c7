// SPDX-License-Identifier: MIT
//
// Leaves whose order still holds are not sorted again, and then only: whatever happens, ids and codes are those of the
// host's stable sort, and whether there was one is what the host says that there had to be.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "builders/stages/leaf_order.h"
#include "builders/stages/standing_order.h"
#include "tests/builders/stage_testing.h"

namespace bvhbench {
namespace {

using enum TreeUpdate;

struct Case {
    KernelForm form;
    std::string order;
};

/// One small triangle at each place.
Mesh triangles_at(const std::vector<Point>& places)
{
    Mesh mesh;
    for (const Point& at : places) {
        const auto first = static_cast<uint>(mesh.points.size());
        mesh.points.insert(mesh.points.end(),
                           {at, {at.x + 1, at.y, at.z}, {at.x, at.y + 1, at.z + 1}});
        mesh.faces.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

/// Places of a lattice, drawn, many of them more than once; the extremes are there, so that all have the same bounds.
std::vector<Point> lattice_places(uint count, uint seed)
{
    std::mt19937 random(seed);
    std::vector<Point> places = {{0, 0, 0}, {64, 64, 64}};
    const auto drawn = [&] { return static_cast<float>(8 * (random() % 9)); };
    while (places.size() < count)
        places.push_back({drawn(), drawn(), drawn()});
    places.resize(count);
    return places;
}

class StandingOrderContract : public testing::TestWithParam<Case> {
protected:
    void start(const std::vector<std::vector<Point>>& objects)
    {
        std::vector<uint> sizes;
        std::vector<FaceRange> ranges;
        uint first = 0;
        for (const std::vector<Point>& places : objects) {
            sizes.push_back(static_cast<uint>(places.size()));
            ranges.push_back({first, sizes.back()});
            first += sizes.back();
        }
        objects_ = objects;
        mesh_ = triangles_at(joined_places());
        order_ = std::make_unique<LeafOrder>(bench().programs, GetParam().order, GetParam().form);
        reserve([&](Arena& arena) {
            order_->plan(arena, sizes, Use::tree, true);
            order_->plan_updates(arena);
        });
        order_->prepare(queue());
        order_->prepare_updates(queue());
        input_.emplace(upload(bench().device, bench().queue, mesh_.points, mesh_.faces, ranges));
        order_->enqueue(*input_, bench().queue);
        bench().queue.finish();
        EXPECT_EQ(order_->ids().download(queue()), host_ids());
    }

    static const cl::CommandQueue& queue() { return bench().queue.cl(); }

    std::vector<Point> joined_places() const
    {
        std::vector<Point> all;
        for (const std::vector<Point>& places : objects_)
            all.insert(all.end(), places.begin(), places.end());
        return all;
    }

    HostLeafOrder host_order(std::size_t object) const
    {
        const Mesh alone = triangles_at(objects_[object]);
        return host_leaf_order(face_boxes(alone.points, alone.faces), GetParam().order);
    }

    std::vector<uint> host_ids() const
    {
        std::vector<uint> all;
        for (std::size_t k = 0; k < objects_.size(); ++k) {
            const auto first = static_cast<uint>(all.size());
            for (const uint id : host_order(k).ids)
                all.push_back(first + id);
        }
        return all;
    }

    /// A frame of other places, sampled three times. Objects that are not rebuilt have not moved. Whether it sorted.
    bool update(const std::vector<TreeUpdate>& updates, bool try_order = true)
    {
        mesh_ = triangles_at(joined_places());
        input_->points = mesh_.points;
        input_->device_points.upload(queue(), mesh_.points);
        const std::vector<uint> before = order_->ids().download(queue()), after = host_ids();
        const bool must_sort = !try_order || before != after;
        order_->begin_update(queue(), updates, try_order);
        for (int sample = 0; sample < 3; ++sample) {
            order_->enqueue_update(*input_, bench().queue);
            bench().queue.finish();
            EXPECT_EQ(order_->sorted_anew(queue()), must_sort);
            EXPECT_EQ(order_->ids().download(queue()), after);
            if (objects_.size() == 1)
                expect_codes();
        }
        return order_->sorted_anew(queue());
    }

    void expect_codes()
    {
        const std::vector<uint> words = order_->codes().download(queue());
        const std::vector<ulong> codes = host_order(0).codes;
        const bool is_wide = order_->code_bits() > 32;
        for (std::size_t k = 0; k < codes.size(); ++k)
            ASSERT_EQ(is_wide ? words[2 * k] | ulong{words[2 * k + 1]} << 32 : ulong{words[k]},
                      codes[k])
                << "leaf " << k;
    }

    std::vector<std::vector<Point>> objects_;
    Mesh mesh_;
    std::unique_ptr<LeafOrder> order_;
    std::optional<Input> input_;
};

using StandingOrderOfFew = StandingOrderContract;

TEST_P(StandingOrderOfFew, HoldsWhileCodesAscendInIt)
{
    for (const uint size : {1u, 2u, 3u, 40u}) {
        SCOPED_TRACE(size);
        start({lattice_places(size, 5)});
        EXPECT_FALSE(update({rebuild}));
        for (Point& place : objects_[0])  // exactly, as are all sums of such places
            place = {place.x + 128, place.y - 64, place.z};
        EXPECT_FALSE(update({rebuild}));
        EXPECT_TRUE(update({rebuild}, false));
    }
}

TEST_P(StandingOrderOfFew, IsBrokenByOneSwap)
{
    start({lattice_places(40, 5)});
    const std::vector<uint> ids = host_ids();
    const std::vector<ulong> codes = host_order(0).codes;
    int swaps = 0;
    for (std::size_t k = 0; k + 1 < ids.size(); k += 2) {
        if (codes[k] == codes[k + 1])
            continue;
        ++swaps;
        std::swap(objects_[0][ids[k]], objects_[0][ids[k + 1]]);
        EXPECT_TRUE(update({rebuild}));
        std::swap(objects_[0][ids[k]], objects_[0][ids[k + 1]]);
        EXPECT_TRUE(update({rebuild}));
        EXPECT_FALSE(update({rebuild}));
    }
    EXPECT_GT(swaps, 10);
}

/// Equal codes are no disorder, unless ids descend: a stable sort would turn them round.
TEST_P(StandingOrderOfFew, HoldsOverEqualCodesAsLongAsTheirIdsAscend)
{
    const std::vector<Point> apart = {{0, 0, 0}, {64, 64, 64}, {32, 32, 32}, {8, 8, 8}};
    std::vector<Point> together = apart;
    together[2] = together[3];
    start({together});
    EXPECT_FALSE(update({rebuild}));
    objects_[0] = apart;
    update({rebuild});
    const std::vector<uint> ids = host_ids();
    const auto place = [&](uint id) { return std::find(ids.begin(), ids.end(), id); };
    ASSERT_LT(place(3), place(2));
    objects_[0] = together;
    EXPECT_TRUE(update({rebuild}));
    EXPECT_FALSE(update({rebuild}));
}

TEST_P(StandingOrderOfFew, IsTriedOnThoseObjectsOnlyThatAreLinedUp)
{
    start(
        {lattice_places(3, 1), lattice_places(40, 2), lattice_places(1, 3), lattice_places(20, 4)});
    EXPECT_FALSE(update({rebuild, rebuild, rebuild, rebuild}));
    EXPECT_FALSE(update({keep, rebuild, keep, rebuild}));
    objects_[1] = lattice_places(40, 9);
    EXPECT_TRUE(update({keep, rebuild, keep, keep}));
    EXPECT_FALSE(update({rebuild, keep, rebuild, rebuild}));
    objects_[3] = lattice_places(20, 9);
    objects_[0] = {{0, 8, 16}, {64, 0, 8}, {0, 0, 0}};
    EXPECT_TRUE(update({rebuild, keep, keep, rebuild}));
    EXPECT_FALSE(update({rebuild, rebuild, keep, rebuild}));
}

TEST_P(StandingOrderContract, IsWhatTheHostSaysForManyLeaves)
{
    for (const uint size : {480u, 5'000u}) {
        SCOPED_TRACE(size);
        start({lattice_places(size, 7), lattice_places(size / 3, 8)});
        EXPECT_FALSE(update({rebuild, keep}));
        objects_[0] = lattice_places(size, 9);
        EXPECT_TRUE(update({rebuild, keep}));
        EXPECT_FALSE(update({rebuild, rebuild}));
        // The last two in their order change places: all but the end of it holds.
        const std::vector<uint> ids = host_ids();
        std::swap(objects_[1][ids.back() - size], objects_[1][ids[ids.size() - 40] - size]);
        update({keep, rebuild});
        start({lattice_places(size, 7)});
        EXPECT_FALSE(update({rebuild}));
        objects_[0] = lattice_places(size, 9);
        EXPECT_TRUE(update({rebuild}));
    }
}

/// The stage alone, in small groups: of four objects the second and the last are lined up.
class StandingOrderStage : public testing::TestWithParam<KernelForm> {};

TEST_P(StandingOrderStage, SortsAsideAndPutsBackUnlessItHolds)
{
    constexpr uint bits = 12, object_shift = 8;
    const cl::CommandQueue& queue = bench().queue.cl();
    const std::vector<uint> sizes = {3, 40, 1, 9}, chosen = {1, 3};
    RadixSort sort(bench().programs, bits,
                   {.form = GetParam(), .group_size = 16, .keys_per_item = 1});
    StandingOrder standing(bench().programs, bits, GetParam());
    ObjectRuns runs(bench().device, GetParam(), 16);
    Buffer<uint> ids;
    reserve([&](Arena& arena) {
        sort.plan(arena, 53);
        sort.plan_aside(arena);
        standing.plan(arena, 53);
        runs.plan(arena, sizes);
        ids = arena.take<uint>(53, Use::tree);
    });
    standing.prepare(queue);
    runs.choose(queue, chosen);
    std::vector<uint> expected(53);
    std::iota(expected.begin(), expected.end(), 0u);
    std::reverse(expected.begin() + 3, expected.begin() + 43);
    ids.upload(queue, expected);

    std::mt19937 random(3);
    for (const bool holds : {false, true, false}) {
        std::vector<uint> codes(49);  // of the 40 and the 9
        for (uint k = 0; k < codes.size(); ++k)
            codes[k] = (k < 40 ? 1u : 3u) << object_shift | (holds ? 7u : random() % 16);
        if (holds)  // as they stand
            for (uint k = 0; k < codes.size(); ++k)
                codes[expected[k < 40 ? 3 + k : 4 + k] - (k < 40 ? 3 : 4)] =
                    (k < 40 ? 1u : 3u) << object_shift | k;
        Buffer<uint>(sort.unsorted_codes()).upload(queue, codes);
        standing.take(queue, ids, runs);
        const SortUnlessIdle unless = standing.enqueue_try(sort.unsorted_codes(), bench().queue);
        sort.enqueue_aside(bench().queue, runs.lined_up_triangles(), unless);
        standing.enqueue_put(sort.ids_aside(), ids, runs, unless, bench().queue);
        bench().queue.finish();
        EXPECT_EQ(standing.held(queue), holds);
        std::vector<uint> sorted(49);
        std::iota(sorted.begin(), sorted.end(), 0u);
        std::stable_sort(sorted.begin(), sorted.end(),
                         [&](uint a, uint b) { return codes[a] < codes[b]; });
        for (uint k = 0; k < sorted.size(); ++k)
            expected[k < 40 ? 3 + k : 4 + k] = sorted[k] + (k < 40 ? 3 : 4);
        EXPECT_EQ(ids.download(queue), expected);
    }
}

INSTANTIATE_TEST_SUITE_P(Stage, StandingOrderStage,
                         testing::Values(KernelForm::groups, KernelForm::chunks),
                         [](const auto& instance) { return form_name(instance.param); });

INSTANTIATE_TEST_SUITE_P(
    Orders, StandingOrderContract, testing::ValuesIn([] {
        std::vector<Case> cases;
        for (const char* order : {"morton30", "hilbert30", "morton63", "hilbert63"})
            for (const KernelForm form : {KernelForm::groups, KernelForm::chunks})
                cases.push_back({form, order});
        return cases;
    }()),
    [](const auto& instance) {
        return instance.param.order + "_" + form_name(instance.param.form);
    });

INSTANTIATE_TEST_SUITE_P(
    Few, StandingOrderOfFew, testing::ValuesIn([] {
        std::vector<Case> cases;
        for (const char* order : {"hilbert30", "morton63"})
            for (const KernelForm form : {KernelForm::groups, KernelForm::chunks})
                cases.push_back({form, order});
        return cases;
    }()),
    [](const auto& instance) {
        return instance.param.order + "_" + form_name(instance.param.form);
    });

}  // namespace
}  // namespace bvhbench
