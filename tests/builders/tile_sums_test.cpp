// SPDX-License-Identifier: MIT

#include "builders/stages/sort/waiting_sort.h"
#include "tests/device/testing.h"

namespace bvhbench {
namespace {

constexpr uint digits = 1u << tile_digit_bits;
constexpr uint group_size = 32;
constexpr uint most_tiles = 300;
constexpr uint few_tiles = 5;

// The parts of a sum over tiles in a launch each: all that a group waits for comes from an earlier launch, so any device may
// run them.
constexpr auto kernel_text = R"(
#include "builders/stages/sort/tile_sums.clh"

#define PART __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void
#define TILE_NUMBER (uint)get_group_id(0)
#define TILES (uint)get_num_groups(0)

PART announce_all(volatile global ulong* states, global const uint* counts, const uint epoch)
{
    local uint own[DIGITS];
    for (OWN_DIGITS(digit))
        own[digit] = counts[TILE_NUMBER * DIGITS + digit];
    barrier(CLK_LOCAL_MEM_FENCE);
    announce_counts(states, own, TILE_NUMBER, TILES, epoch);
}

PART sum_all(volatile global ulong* states, const uint epoch)
{
    local uint columns[COLUMN_WORDS];
    sum_own_digits(states, columns, TILE_NUMBER, TILES, epoch);
}

PART find_all(volatile global ulong* states, global uint* found, const uint epoch)
{
    local uint places[DIGITS];
    local uint columns[COLUMN_WORDS];
    local uint team_sums[TEAMS];
    find_places(states, places, columns, team_sums, TILE_NUMBER, TILES, epoch);
    for (OWN_DIGITS(digit))
        found[TILE_NUMBER * DIGITS + digit] = places[digit];
}
)";

class TileSums : public OnDeviceWithKernels {
protected:
    TileSums()
    {
        for (const char* name :
             {"builders/stages/code.clh", "builders/stages/sort/digit_counts.clh",
              "builders/stages/sort/peers.clh", "builders/stages/sort/tile_digits.clh",
              "builders/stages/sort/look_back.clh", "builders/stages/sort/tile_sums.clh",
              "device/handoff.clh"})
            folder.file(name, embedded_kernel(name).value());
        folder.file("parts.cl", kernel_text);
    }

    template <class... Arguments>
    void run(const char* name, uint tiles, const Arguments&... arguments)
    {
        cl::Kernel kernel = programs.kernel("parts.cl", name,
                                            {{"GROUP_SIZE", group_size},
                                             {"KEYS_PER_ITEM", 1},
                                             {"CODE_WORDS", 1},
                                             {"DIGIT_BITS", tile_digit_bits},
                                             {"MOST_TILES", most_tiles},
                                             {"FEW_TILES", few_tiles},
                                             {"STATE_EPOCH_BITS", 31}},
                                            Optimise::on_gpus);
        set_arguments(kernel, arguments...);
        queue.begin(name);
        queue.launch(kernel, std::size_t{tiles} * group_size, group_size, 1);
    }
};

/// Returns where pairs begin, by tile and digit: after all with smaller digits and after those with the digit in earlier tiles.
std::vector<uint> host_places(const std::vector<uint>& counts, uint tiles)
{
    std::vector<uint> places(counts.size());
    uint sum = 0;
    for (uint digit = 0; digit < digits; ++digit)
        for (uint tile = 0; tile < tiles; ++tile) {
            places[tile * digits + digit] = sum;
            sum += counts[tile * digits + digit];
        }
    return places;
}

TEST_F(TileSums, TellEveryTileWhereItsPairsBegin)
{
    auto states = buffer<ulong>((2 * most_tiles + 1) * digits);
    states.upload(queue.cl(), std::vector<ulong>(states.size()));
    uint epoch = 0;
    // So few that each group reads all counts; then fewer than digits, as many, and more, when some groups add up no digit.
    for (const uint tiles :
         {1u, 2u, few_tiles, few_tiles + 1, 37u, 132u, 255u, 256u, 257u, most_tiles}) {
        SCOPED_TRACE(tiles);
        std::vector<uint> values(std::size_t{tiles} * digits);
        for (std::size_t k = 0; k < values.size(); ++k)
            values[k] = static_cast<uint>(k * 2654435761u >> 7u) % 8192u;
        auto counts = buffer<uint>(values.size());
        const auto found = buffer<uint>(values.size());
        counts.upload(queue.cl(), values);
        ++epoch;  // what earlier sums left in `states` counts as absent
        run("announce_all", tiles, states, counts, epoch);
        if (tiles > few_tiles)
            run("sum_all", tiles, states, epoch);
        run("find_all", tiles, states, found, epoch);
        EXPECT_EQ(found.download(queue.cl()), host_places(values, tiles));
        queue.finish();
    }
}

}  // namespace
}  // namespace bvhbench
