// SPDX-License-Identifier: MIT
#include "cluster/agreeing_ranks.h"

#include <gtest/gtest.h>

#include <atomic>

#include "tests/cluster/thread_ranks.h"

namespace bvhbench {
namespace {

constexpr uint ranks_here = 3;
constexpr int steps = 7;

/// Sends one message of each kind, and checks what comes.
void talk(AgreeingRanks& ranks, int step)
{
    std::array<std::uint64_t, 1> sum{ranks.rank() + 1u};
    std::array<float, 1> least{-static_cast<float>(ranks.rank())};
    const std::array<uint, 1> own{ranks.rank()};
    switch (step) {
        case 0:
            return ranks.wait_for_all();
        case 1:
            ranks.sum(sum);
            EXPECT_EQ(sum[0], 6u);
            return;
        case 2:
            ranks.least(least);
            EXPECT_EQ(least[0], -2);
            return;
        case 3:
            EXPECT_EQ(gathered<uint>(ranks, own), (std::vector<uint>{0, 1, 2}));
            return;
        default:
            for (const auto& from : exchanged(ranks, std::vector(ranks_here, std::vector{7u})))
                EXPECT_EQ(from, std::vector{7u});
    }
}

/// Each rank sends its messages, one after the other; those of `failing` fail before step `at`. Returns how many ranks heard of it.
int hearing(const std::vector<uint>& failing, int at)
{
    std::atomic<int> heard = 0;
    on_ranks(ranks_here, [&](Ranks& plain) {
        AgreeingRanks ranks(plain);
        try {
            for (int step = 0; step < steps; ++step) {
                if (step == at && std::ranges::count(failing, ranks.rank()) > 0)
                    throw std::runtime_error("fails");
                talk(ranks, step);
            }
            if (ranks.any_failed(false))
                ++heard;
        } catch (const OtherRankFailed&) {
            ++heard;
        } catch (const std::runtime_error&) {
            EXPECT_TRUE(ranks.any_failed(true));
            ++heard;
        }
    });
    return heard;
}

TEST(AgreeingRanks, SendWhatTheyAreGiven) { EXPECT_EQ(hearing({}, 0), 0); }

TEST(AgreeingRanks, AllHearOfAFailureAnywhere)
{
    for (int at = 0; at < steps; ++at)
        for (const std::vector<uint>& failing :
             {std::vector{0u}, std::vector{2u}, std::vector{0u, 1u}, std::vector{0u, 1u, 2u}})
            EXPECT_EQ(hearing(failing, at), 3) << at;
}

}  // namespace
}  // namespace bvhbench
