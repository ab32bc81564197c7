// SPDX-License-Identifier: MIT
#include "cluster/partition.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <tuple>

#include "geometry/grid.h"
#include "geometry/hilbert.h"
#include "tests/cluster/thread_ranks.h"

namespace bvhbench {
namespace {

struct Cloud {
    std::vector<Point> centres;
    std::vector<uint> weights;
};

/// Returns `count` centres on a coarse grid, so that many coordinates are equal, some negative, with weights from 1 to 9.
Cloud cloud_of(uint count, uint cells)
{
    std::mt19937 random(count + cells);
    const auto number = [&] {
        return static_cast<float>(random() % cells) - 0.5f * static_cast<float>(cells / 2);
    };
    Cloud cloud;
    for (uint k = 0; k < count; ++k) {
        cloud.centres.push_back({number(), 2 * number(), 0.25f * number()});
        cloud.weights.push_back(1 + static_cast<uint>(random() % 9));
    }
    return cloud;
}

/// Partitions the cloud, whose triangle k rank owner(k) has. Returns the part of each triangle.
std::vector<uint> parts_of(const Cloud& cloud, PartitionBy by, uint parts, uint ranks_count,
                           const std::function<uint(uint)>& owner, bool weighted)
{
    std::vector<uint> part(cloud.centres.size());
    on_ranks(ranks_count, [&](Ranks& ranks) {
        std::vector<Point> centres;
        std::vector<uint> ids, weights;
        for (uint k = 0; k < cloud.centres.size(); ++k)
            if (owner(k) == ranks.rank()) {
                centres.push_back(cloud.centres[k]);
                ids.push_back(k);
                weights.push_back(cloud.weights[k]);
            }
        PlacedTriangles placed{centres, ids};
        if (weighted)
            placed.weights = weights;
        const std::vector<uint> own = partitioned(placed, by, parts, ranks);
        ASSERT_EQ(own.size(), ids.size());
        for (std::size_t k = 0; k < ids.size(); ++k)
            part[ids[k]] = own[k];
    });
    return part;
}

uint all_on_first(uint) { return 0; }
uint every_other(uint k) { return 1 - k % 2; }

/// The oracle of rcb: sorts all triangles of a group along its axis and cuts the list.
void cut_sorted(const Cloud& cloud, bool weighted, std::vector<uint> ids, uint first, uint parts,
                std::vector<uint>& part)
{
    if (parts == 1) {
        for (const uint id : ids)
            part[id] = first;
        return;
    }
    Aabb box = empty_box();
    std::uint64_t all = 0;
    const auto weight = [&](uint id) { return weighted ? cloud.weights[id] : 1u; };
    for (const uint id : ids) {
        const Point at = cloud.centres[id];
        box = merged(box, {at.x, at.y, at.z, at.x, at.y, at.z});
        all += weight(id);
    }
    const float x = box.max_x - box.min_x, y = box.max_y - box.min_y, z = box.max_z - box.min_z;
    const auto along = x >= y && x >= z ? &Point::x : y >= z ? &Point::y : &Point::z;
    std::ranges::sort(ids, {}, [&](uint id) { return std::tuple(cloud.centres[id].*along, id); });
    const std::uint64_t most = all * (parts / 2) / parts;
    std::uint64_t taken = 0;
    std::size_t cut = 0;
    while (cut < ids.size() && taken + weight(ids[cut]) <= most)
        taken += weight(ids[cut++]);
    const auto middle = ids.begin() + static_cast<std::ptrdiff_t>(cut);
    cut_sorted(cloud, weighted, {ids.begin(), middle}, first, parts / 2, part);
    cut_sorted(cloud, weighted, {middle, ids.end()}, first + parts / 2, parts - parts / 2, part);
}

std::vector<uint> all_ids(const Cloud& cloud)
{
    std::vector<uint> ids(cloud.centres.size());
    std::iota(ids.begin(), ids.end(), 0u);
    return ids;
}

/// The oracle of the curve: sorts all triangles by their codes and cuts the list.
std::vector<uint> cut_curve(const Cloud& cloud, uint parts)
{
    Bounds bounds = empty_bounds();
    const auto box_of = [&](uint id) {
        const Point at = cloud.centres[id];
        return Aabb{at.x, at.y, at.z, at.x, at.y, at.z};
    };
    std::vector<uint> ids = all_ids(cloud);
    for (const uint id : ids)
        bounds = grown(bounds, box_of(id));
    std::ranges::sort(ids, {}, [&](uint id) {
        return std::pair(hilbert_63(cubic_cell(box_of(id), bounds, 0x1p21f)), id);
    });
    std::vector<uint> part(ids.size());
    for (uint p = 0; p < parts; ++p)
        for (std::uint64_t k = curve_cut(ids.size(), p, parts);
             k < curve_cut(ids.size(), p + 1, parts); ++k)
            part[ids[k]] = p;
    return part;
}

std::vector<std::uint64_t> sizes_of(const std::vector<uint>& part, uint parts)
{
    std::vector<std::uint64_t> sizes(parts);
    for (const uint p : part)
        ++sizes.at(p);
    return sizes;
}

constexpr uint part_counts[] = {1, 2, 3, 5, 8, 13};

TEST(Partition, OfRcbIsThatOfSortedLists)
{
    for (const bool weighted : {false, true})
        for (const uint count : {0u, 1u, 3u, 7u, 3000u})
            for (const uint parts : part_counts) {
                const Cloud cloud = cloud_of(count, 17);
                std::vector<uint> expected(cloud.centres.size());
                cut_sorted(cloud, weighted, all_ids(cloud), 0, parts, expected);
                EXPECT_EQ(parts_of(cloud, PartitionBy::rcb, parts, 2, every_other, weighted),
                          expected)
                    << count << " in " << parts << " parts";
            }
}

TEST(Partition, OfCurveIsThatOfASortedList)
{
    for (const uint count : {0u, 1u, 3u, 3000u})
        for (const uint parts : part_counts) {
            const Cloud cloud = cloud_of(count, 40);
            EXPECT_EQ(parts_of(cloud, PartitionBy::curve, parts, 2, every_other, false),
                      cut_curve(cloud, parts))
                << count << " in " << parts << " parts";
        }
}

TEST(Partition, DoesNotDependOnWhoHasWhat)
{
    const Cloud cloud = cloud_of(2000, 30);
    for (const PartitionBy by : {PartitionBy::rcb, PartitionBy::curve}) {
        const bool weighted = by == PartitionBy::rcb;
        const std::vector<uint> expected = parts_of(cloud, by, 5, 1, all_on_first, weighted);
        const std::function<uint(uint)> owners[] = {
            [](uint k) { return k % 3; }, [](uint k) { return k < 1999 ? 2u : 0u; },
            [](uint k) { return k * 2654435761u >> 16 & 3u; }};
        for (const auto& owner : owners)
            EXPECT_EQ(parts_of(cloud, by, 5, 4, owner, weighted), expected);
    }
}

TEST(Partition, OfCurveCutsNoBlock)
{
    EXPECT_EQ(curve_block(1152000, 8), 4096u);
    for (const std::uint64_t count : {0u, 1u, 63u, 100u, 3000u, 1152000u})
        for (const uint parts : part_counts) {
            const std::uint64_t block = curve_block(count, parts);
            EXPECT_EQ(curve_cut(count, 0, parts), 0u);
            EXPECT_EQ(curve_cut(count, parts, parts), count);
            for (uint p = 0; p < parts; ++p) {
                EXPECT_EQ(curve_cut(count, p, parts) % block, 0u);
                EXPECT_NEAR(static_cast<double>(curve_cut(count, p, parts)),
                            static_cast<double>(count) * p / parts, 2 * static_cast<double>(block));
            }
        }
}

TEST(Partition, OfOnePlaceCutsByIds)
{
    const Cloud cloud{std::vector<Point>(100, Point{3, 3, 3}), std::vector<uint>(100, 1)};
    for (const PartitionBy by : {PartitionBy::rcb, PartitionBy::curve}) {
        const std::vector<uint> part = parts_of(cloud, by, 4, 2, every_other, false);
        EXPECT_TRUE(std::ranges::is_sorted(part));
        EXPECT_EQ(sizes_of(part, 4), std::vector<std::uint64_t>(4, 25));
    }
}

}  // namespace
}  // namespace bvhbench
