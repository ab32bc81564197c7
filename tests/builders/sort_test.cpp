// SPDX-License-Identifier: MIT
#include "builders/stages/sort/sort.h"

#include "tests/builders/stage_testing.h"

namespace bvhbench {
namespace {

/// Reference sort: returns the ids of `codes` in ascending order; ties keep their order.
std::vector<uint> host_sorted_ids(const std::vector<ulong>& codes)
{
    std::vector<uint> ids(codes.size());
    std::iota(ids.begin(), ids.end(), 0u);
    std::ranges::stable_sort(ids, {}, [&](uint id) { return codes[id]; });
    return ids;
}

std::vector<uint> words_of(const std::vector<ulong>& codes, unsigned bits)
{
    std::vector<uint> words;
    for (const ulong code : codes) {
        words.push_back(static_cast<uint>(code));
        if (code_words(bits) == 2)
            words.push_back(static_cast<uint>(code >> 32));
    }
    return words;
}

struct NamedCodes {
    std::string name;
    std::vector<ulong> codes;
};

std::vector<ulong> any_codes(std::size_t size, unsigned bits)
{
    std::mt19937_64 random(size);
    std::vector<ulong> codes(size);
    std::ranges::generate(codes, [&] { return random() & ((ulong{1} << bits) - 1); });
    return codes;
}

std::vector<NamedCodes> hard_codes(std::size_t size, unsigned bits)
{
    const ulong largest = (ulong{1} << bits) - 1;
    std::mt19937_64 random(size);
    const std::vector<ulong> any = any_codes(size, bits);
    std::vector<ulong> few(size), few_high(size), low(size), patches(size), runs(size);
    for (std::size_t k = 0; k < size; ++k) {
        few[k] = random() % 5;
        low[k] = any[k] >> bits / 3;  // one highest digit, and many next ones
        few_high[k] = largest - (random() % 3 << (bits - 7));
        patches[k] = (k / 37 * 0x9e3779b97f4a7c15u) & largest;
        // Runs of some 8 codes, alike but for two bits.
        runs[k] = any[random() % (size / 8 + 1)] ^ random() % 4;
    }
    std::vector<ulong> ascending = any;
    std::sort(ascending.begin(), ascending.end());
    // First those whose runs are short (sort_runs.cl), in turn: each sort clears what the next but one starts from.
    return {{"any", any},
            {"runs", runs},
            {"ascending", ascending},
            {"descending", {ascending.rbegin(), ascending.rend()}},
            {"few", few},
            {"few high", few_high},
            {"low", low},
            {"patches", patches},
            {"all zero", std::vector<ulong>(size, 0)},
            {"all ones", std::vector<ulong>(size, largest)}};
}

struct Case {
    std::string name;
    unsigned bits;
    SortShape shape;
    bool keeps_codes = true;
};

/// Returns the shape with the smallest groups: one team on GPUs, and 16 work-items on CPUs, where a team is one work-item.
SortShape sweeping(uint keys_per_item)
{
    SortShape shape{KernelForm::groups};
    shape.sweeps = SortShape::Sweeps::always;
    shape.sweep_group_size = bench().device.is_cpu() ? 16 : 32;
    shape.sweep_keys_per_item = keys_per_item;
    shape.keys_at_once = 0;
    return shape;
}

/// As `sweeping`, with all passes in one launch of as many groups as may wait for each other; one group if none may.
SortShape at_once(uint keys_per_item)
{
    SortShape shape = sweeping(keys_per_item);
    shape.keys_at_once = keys_per_item;
    return shape;
}

SortShape three_launches(uint group_size = 256, uint keys_per_item = 15)
{
    SortShape shape{KernelForm::groups, group_size, keys_per_item};
    shape.sweeps = SortShape::Sweeps::never;
    return shape;
}

void plan(RadixSort& sort, std::size_t size, bool keeps_codes = true)
{
    reserve([&](Arena& arena) { sort.plan(arena, size, keeps_codes); });
    sort.prepare(bench().queue.cl());
}

void enqueue(RadixSort& sort, const std::vector<uint>& words)
{
    Buffer<uint> unsorted = sort.unsorted_codes();
    unsorted.upload(bench().queue.cl(), words);
    sort.enqueue(bench().queue);
}

class RadixSortContract : public testing::TestWithParam<Case> {
protected:
    void plan(std::size_t size) { ::bvhbench::plan(sort_, size, GetParam().keeps_codes); }

    void expect_equal_to_host(const std::vector<ulong>& codes)
    {
        enqueue(sort_, words_of(codes, GetParam().bits));
        bench().queue.finish();

        const std::vector<uint> expected = host_sorted_ids(codes);
        std::vector<ulong> sorted(codes.size());
        std::ranges::transform(expected, sorted.begin(), [&](uint id) { return codes[id]; });
        // EXPECT_EQ would print millions of numbers.
        EXPECT_TRUE(same_bits(from_device(sort_.ids()), expected));
        if (GetParam().keeps_codes) {
            EXPECT_TRUE(same_bits(from_device(sort_.codes()), words_of(sorted, GetParam().bits)));
        }
    }

    RadixSort sort_{bench().programs, GetParam().bits, GetParam().shape};
};

using RadixSortOfEverySize = RadixSortContract;
using RadixSortAsShipped = RadixSortContract;
using RadixSortOfFewSizes = RadixSortContract;

std::string case_name(const testing::TestParamInfo<Case>& instance)
{
    return instance.param.name + "_" + std::to_string(instance.param.bits);
}

TEST_P(RadixSortOfEverySize, EqualsAStableSortUpToPastTwoTiles)
{
    const SortShape& shape = GetParam().shape;
    const bool sweeps = shape.sweeps == SortShape::Sweeps::always;
    const uint tile = sweeps ? shape.sweep_group_size * shape.sweep_keys_per_item
                             : shape.group_size * shape.keys_per_item;
    const std::size_t last = 2 * std::size_t{tile} + 1;
    std::vector<std::size_t> sizes(last + 1);
    std::iota(sizes.begin(), sizes.end(), std::size_t{0});
    // As many tiles as the group that scans their counts has work-items, and one less and one more.
    if (!sweeps)
        for (const std::size_t tiles :
             {shape.group_size - 1, shape.group_size, shape.group_size + 1})
            sizes.push_back(tiles * tile);
    for (const std::size_t size : sizes) {
        plan(size);
        // Tests every size with the codes "any" and "few", and sizes around the ends of tiles with all kinds of codes.
        const std::size_t past = size % tile;
        const bool at_an_end = past <= 1 || past == tile - 1;
        for (const auto& [name, codes] : hard_codes(size, GetParam().bits)) {
            if (!at_an_end && name != "any" && name != "few")
                continue;
            SCOPED_TRACE(name + ", " + std::to_string(size) + " codes");
            expect_equal_to_host(codes);
        }
    }
}

// Tiles of 48 pairs, so that all sizes are tested and a few thousand pairs need many rounds of the scan.
INSTANTIATE_TEST_SUITE_P(Small, RadixSortOfEverySize, testing::ValuesIn([] {
                             std::vector<Case> cases;
                             for (const unsigned bits : {8, 30, 32, 63}) {
                                 cases.push_back({"groups", bits, three_launches(16, 3)});
                                 cases.push_back({"sweeps", bits, sweeping(2)});
                                 cases.push_back({"words", bits, sweeping(2), false});
                                 cases.push_back({"at_once", bits, at_once(6)});
                                 SortShape chunks{KernelForm::chunks, 16, 3};
                                 chunks.pairs_per_chunk = 1;
                                 cases.push_back({"chunks", bits, chunks});
                                 chunks.few_pairs = 0, chunks.large_bucket = 1;
                                 cases.push_back({"buckets", bits, chunks});
                             }
                             return cases;
                         }()),
                         case_name);

TEST_P(RadixSortAsShipped, EqualsAStableSortAroundEveryBoundary)
{
    if (GetParam().name == "of_device" && !bench().device.lets_groups_wait())
        GTEST_SKIP() << "groups may not wait for each other: it is the sort called groups";
    constexpr std::size_t tile = 256 * 15;
    for (const std::size_t size :
         {std::size_t{1}, tile - 1, tile, tile + 1, 2 * tile - 1, 2 * tile, 2 * tile + 1}) {
        plan(size);
        for (const auto& [name, codes] : hard_codes(size, GetParam().bits)) {
            SCOPED_TRACE(name + ", " + std::to_string(size) + " codes");
            expect_equal_to_host(codes);
        }
    }
    plan(257 * tile + 1);
    expect_equal_to_host(any_codes(257 * tile + 1, GetParam().bits));
}

// By day each kind once: large groups take seconds to compile.
INSTANTIATE_TEST_SUITE_P(Default, RadixSortAsShipped, testing::ValuesIn([] {
                             std::vector<Case> cases = {{"groups", 63, three_launches()},
                                                        {"sweeps", 30, sweeping(8)},
                                                        {"words", 48, sweeping(8), false},
                                                        {"at_once", 30, at_once(8)},
                                                        {"of_device", 30, {KernelForm::groups}},
                                                        {"chunks", 63, {KernelForm::chunks}}};
                             if (takes_all_cases())
                                 cases.insert(cases.end(), {{"groups", 30, three_launches()},
                                                            {"words", 30, sweeping(8), false},
                                                            {"of_device", 63, {KernelForm::groups}},
                                                            {"chunks", 30, {KernelForm::chunks}}});
                             return cases;
                         }()),
                         case_name);

TEST(RadixSort, EqualsAStableSortPastTheIntegersOfAFloat)
{
    if (!takes_all_cases())
        GTEST_SKIP() << "takes ten seconds: at night";
    const std::size_t size = (std::size_t{1} << 24) + 3;
    std::mt19937 random(3);
    std::vector<uint> codes(size);
    std::ranges::generate(codes, [&] { return static_cast<uint>(random() >> 2); });
    RadixSort sort(bench().programs, 30);
    plan(sort, size);
    enqueue(sort, codes);

    // The result is correct if codes ascend, ids ascend among equal codes, and every code is that of its id.
    const std::vector<uint> ids = from_device(sort.ids());
    const std::vector<uint> sorted = from_device(sort.codes());
    bench().queue.finish();
    for (std::size_t k = 0; k < size; ++k) {
        ASSERT_EQ(sorted[k], codes[ids[k]]) << k;
        const bool ascends = k == 0 || sorted[k - 1] < sorted[k] ||
                             (sorted[k - 1] == sorted[k] && ids[k - 1] < ids[k]);
        ASSERT_TRUE(ascends) << k;
    }
}

TEST_P(RadixSortOfFewSizes, EqualsAStableSort)
{
    for (const std::size_t size : {1, 50, 1000}) {
        SCOPED_TRACE(size);
        plan(size);
        expect_equal_to_host(hard_codes(size, GetParam().bits).front().codes);
    }
}

// Sizes that are small enough for an interpreter that checks every access. By day it takes each kind of sort once, and codes of one
// word and of two.
INSTANTIATE_TEST_SUITE_P(Few, RadixSortOfFewSizes, testing::ValuesIn([] {
                             std::vector<Case> cases = {{"groups", 63, three_launches(32, 15)},
                                                        {"sweeps", 30, sweeping(3)},
                                                        {"words", 30, sweeping(3), false},
                                                        {"at_once", 63, at_once(128)}};
                             if (!takes_few_cases())
                                 cases.insert(cases.end(), {{"groups", 30, three_launches(16, 3)},
                                                            {"sweeps", 48, sweeping(4)},
                                                            {"sweeps", 63, sweeping(4)},
                                                            {"words", 63, sweeping(4), false},
                                                            {"at_once", 30, at_once(64)},
                                                            {"chunks", 30, {KernelForm::chunks}}});
                             return cases;
                         }()),
                         case_name);

/// Each pass of the sort in one launch marks its words with a number of 12 bits, and words are cleared before these repeat.
TEST(RadixSort, InOneLaunchSortsMoreOftenThanItsMarksLast)
{
    constexpr uint bits = 63, passes = 8, sorts = (1u << 12) / passes + 3;
    RadixSort sort(bench().programs, bits, at_once(6));
    const std::vector<ulong> early = {5, 4, 3, 2, 1}, late = {1ul << 60, 3, 1ul << 61, 1, 0};
    plan(sort, early.size());
    for (uint k = 0; k < sorts; ++k)
        enqueue(sort, words_of(k < sorts / 2 ? early : late, bits));
    EXPECT_EQ(from_device(sort.ids()), host_sorted_ids(late));
    bench().queue.finish();
}

/// An update orders some objects anew while the ids of the last sort are still in use.
TEST(RadixSort, AsideKeepsTheIdsOfTheSortBefore)
{
    for (const bool keeps_codes : {false, true})
        for (const unsigned bits : {8, 24, 30, 32, 48, 63}) {
            SCOPED_TRACE(std::to_string(bits) + (keeps_codes ? " bits, kept" : " bits"));
            RadixSort sort(bench().programs, bits, sweeping(2));
            reserve([&](Arena& arena) {
                sort.plan(arena, 200, keeps_codes);
                sort.plan_aside(arena);
            });
            sort.prepare(bench().queue.cl());
            const std::vector<ulong> all = hard_codes(200, bits)[0].codes;
            const std::vector<ulong> some = hard_codes(101, bits)[0].codes;
            enqueue(sort, words_of(all, bits));
            Buffer<uint> unsorted = sort.unsorted_codes_aside();
            unsorted.upload(bench().queue.cl(), words_of(some, bits));
            sort.enqueue_aside(bench().queue, static_cast<uint>(some.size()));
            bench().queue.finish();
            EXPECT_EQ(from_device(sort.ids()), host_sorted_ids(all));
            std::vector<uint> aside = from_device(sort.ids_aside());
            aside.resize(some.size());
            EXPECT_EQ(aside, host_sorted_ids(some));
        }
}

/// Words of 64 bits need no more memory than codes and ids apart.
TEST(RadixSort, TakesAsMuchMemoryWhetherCodesAreKeptOrNot)
{
    for (const unsigned bits : {8, 24, 30}) {
        Footprint footprints[2];
        for (const bool keeps_codes : {false, true}) {
            Arena arena = Arena::measuring(bench().device);
            RadixSort sort(bench().programs, bits, sweeping(2));
            sort.plan(arena, 1024, keeps_codes);
            footprints[keeps_codes ? 1 : 0] = arena.used();
        }
        EXPECT_EQ(footprints[0], footprints[1]) << bits;
    }
}

/// A pass of three launches sorts by one byte.
TEST(RadixSort, TakesNoMorePassesThanACodeHasBytes)
{
    for (const unsigned bits : {30, 47, 48, 49, 63}) {
        RadixSort sort(bench().programs, bits, three_launches(16, 3));
        plan(sort, 100);
        sort.enqueue(bench().queue);
        const std::vector<StageTime> stages = bench().queue.finish();
        ASSERT_EQ(stages.size(), 1u);
        EXPECT_EQ(stages[0].launches, 3 * ((bits + 7) / 8)) << bits;
    }
}

TEST(RadixSort, KeepsOnlyTheSortedIdsAsPartOfTheTree)
{
    for (const unsigned bits : {8, 16, 30, 63}) {
        Arena arena = Arena::measuring(bench().device);
        RadixSort sort(bench().programs, bits);
        sort.plan(arena, 1000);
        EXPECT_EQ(arena.used().tree_bytes, 1000 * sizeof(uint));
    }
}

}  // namespace
}  // namespace bvhbench
