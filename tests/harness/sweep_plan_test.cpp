// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/error.h"
#include "harness/session.h"
#include "harness/sweep/plan.h"
#include "harness/sweep/sizes.h"
#include "harness/sweep/time_left.h"
#include "harness/sweep/units.h"

namespace bvhbench {
namespace {

using Sizes = std::vector<std::int64_t>;

TEST(Sizes, AreListsProductsAndSums)
{
    EXPECT_EQ(sizes_called("1000:1000000:x10"), (Sizes{1000, 10000, 100000, 1000000}));
    EXPECT_EQ(sizes_called("1000:999999:x10"), (Sizes{1000, 10000, 100000}));
    EXPECT_EQ(sizes_called("10:60:+25"), (Sizes{10, 35, 60}));
    EXPECT_EQ(sizes_called("8:20:x1.5"), (Sizes{8, 12, 18}));
    EXPECT_EQ(sizes_called("1:10:x1.0001").size(), 10u) << "each once";
    EXPECT_EQ(sizes_called("500,70,500,60:70:+10"), (Sizes{60, 70, 500}));
    for (const char* text :
         {"", ",", "a", "0", "-5", "1:2", "1:2:3", "1:2:x", "1:2:x0.5", "1:2:+0.5", "1:2:x2:3",
          "2:1:x2", "1e3", "99999999999", "1:2:xnan", "1:2:xinf"})
        EXPECT_THROW(sizes_called(text), BadUsage) << text;
}

Sweep swept(const char* text) { return sweep_of(Json::parse(text)); }

TEST(SweepPlan, IsTheProductWithEachCellOnce)
{
    const Sweep sweep =
        swept(R"({"scenes": ["torus", "soup:9", "refine:bunny:{size}"], "sizes": "10:100:x10",
        "builders": ["perfect", "karras", "perfect"], "orders": ["morton30", "kd"],
        "set": {"leaves": ["mesh", "sorted"]}})");
    EXPECT_EQ(sweep.cells.size(), 5u * 2 * 2 * 2);
    EXPECT_EQ(sweep.product, "5 scenes x 3 builders x 2 orders x 2 values of leaves");
    EXPECT_EQ(sweep.cells.front().scene_name(), "torus:10");
    EXPECT_EQ(sweep.cells.back().scene_name(), "refine:bunny:100");
    EXPECT_EQ(sweep.cells.back().triangles, 100);
    // A collider without a tree is there once, whoever builds.
    EXPECT_EQ(
        swept(
            R"({"scenes": ["soup:9"], "builders": ["perfect", "karras"], "colliders": ["leaf", "grid"]})")
            .cells.size(),
        3u);
}

TEST(SweepPlan, SaysWhyACombinationCannotBeAndWhichWordIsNone)
{
    const Sweep sweep = swept(
        R"({"scenes": ["soup:9"], "builders": ["perfect", "oibvh-wide4"], "set": {"boxes": ["f32", "u16"]}})");
    ASSERT_EQ(sweep.cells.size(), 4u);
    EXPECT_TRUE(sweep.cells[1].why_not.empty());
    EXPECT_TRUE(sweep.cells[1].builder.sorted_leaves) << "as boxes of other formats want them";
    EXPECT_NE(sweep.cells[3].why_not.find("oibvh-wide4 keeps its boxes in its own way"),
              std::string::npos);
    EXPECT_EQ(units_of(sweep, false, "").size(), 3u);
    EXPECT_THROW(
        swept(R"({"scenes": ["soup:9"], "builders": ["perfect"], "set": {"boxes": ["u15"]}})"),
        BadUsage);
}

TEST(SweepPlan, UnitsAreWhatIsMeasuredAndHow)
{
    const char* const text =
        R"({"scenes": ["soup:9", "torus:9"], "builders": ["perfect"], "colliders": ["leaf", "bvtt"]})";
    const std::vector<SweepUnit> apart = units_of(swept(text), false, "a");
    const std::vector<SweepUnit> together = units_of(swept(text), true, "a");
    EXPECT_EQ(apart.size(), 4u);
    ASSERT_EQ(together.size(), 2u);
    EXPECT_EQ(together[1].cells.size(), 2u);
    EXPECT_EQ(units_of(swept(text), false, "a")[2].what, apart[2].what);
    EXPECT_NE(units_of(swept(text), false, "b")[2].what, apart[2].what);
    EXPECT_NE(apart[0].what, apart[1].what);
}

TEST(Shards, AreAllOfItEachOnceAndBalanced)
{
    const std::vector<SweepUnit> units = units_of(
        swept(
            R"({"scenes": ["torus"], "sizes": "1000:8000000:x2", "builders": ["perfect", "karras"]})"),
        false, "");
    const std::vector<unsigned> shards = shards_of(units, 4);
    ASSERT_EQ(shards.size(), units.size());
    std::vector<std::int64_t> load(4), largest(4);
    for (std::size_t i = 0; i < units.size(); ++i) {
        ASSERT_TRUE(shards[i] >= 1 && shards[i] <= 4);
        load[shards[i] - 1] += units[i].triangles;
    }
    const std::int64_t most = units.back().triangles;
    EXPECT_LE(
        *std::max_element(load.begin(), load.end()) - *std::min_element(load.begin(), load.end()),
        most);
    EXPECT_EQ(shards_of(units, 4), shards);
    EXPECT_EQ(shard_called("2/8").number, 2u);
    EXPECT_EQ(shard_called("2/8").of, 8u);
}

TEST(TimeLeft, GoesByTheTrianglesOfItsKind)
{
    TimeLeft left;
    left.add("a", 100000, 2);
    EXPECT_DOUBLE_EQ(left.seconds_of("a", 100000), 2);
    EXPECT_DOUBLE_EQ(left.seconds_of("b", 300000), 4) << "starting counts as 100000 triangles";
    left.add("a", 1100000, 12);
    EXPECT_DOUBLE_EQ(left.seconds_of("a", 2100000), 22);
    left.add("b", 100000, 20);
    EXPECT_DOUBLE_EQ(left.seconds_of("a", 2100000), 22);
    left.add("b", 200000, 40);
    EXPECT_DOUBLE_EQ(left.seconds_of("b", 400000), 80) << "no time to start is less than none";
    left.add("c", 1000, 3);
    left.add("c", 2000, 1);
    EXPECT_DOUBLE_EQ(left.seconds_of("c", 50000), 2) << "no triangle takes less than none";
    EXPECT_EQ(rough_time(0.2), "1 s");
    EXPECT_EQ(rough_time(89.5), "2 min");
    EXPECT_EQ(rough_time(3600 * 5 + 1200), "5 h 20 min");
    EXPECT_EQ(rough_time(86400 * 2 + 3 * 3600), "2 d 3 h");
}

TEST(Colliders, SayInTheListWhetherTheyNeedATree)
{
    Session session(CommonOptions{});
    for (const ColliderEntry& entry : collider_catalog())
        if (entry.make != nullptr) {
            EXPECT_EQ(make_collider(entry.name, session.programs(), {.keep_adjacent = false})
                          ->needs_tree(),
                      entry.needs_tree)
                << entry.name;
        }
}

}  // namespace
}  // namespace bvhbench
