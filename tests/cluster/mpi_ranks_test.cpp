// SPDX-License-Identifier: MIT
#include "tests/cluster/rank_tests.h"

namespace bvhbench {
namespace {

/// Returns what rank `from` sends to rank `to`: nothing, a few bytes, or several messages' worth.
std::vector<uint> message(uint from, uint to)
{
    std::vector<uint> values((from * 3 + to * 5) % 4 * 700);
    for (uint k = 0; k < values.size(); ++k)
        values[k] = from * 1000000 + to * 10000 + k;
    return values;
}

TEST(MpiRanks, AreNumbered)
{
    EXPECT_LT(ranks->rank(), ranks->count());
    EXPECT_LT(ranks->local_rank(), ranks->local_count());
    EXPECT_EQ(ranks->local_count(), ranks->count());  // all on this host
    EXPECT_FALSE(ranks->host().empty());
    const uint own[] = {ranks->rank()};
    const std::vector<uint> all = gathered<uint>(*ranks, own);
    for (uint rank = 0; rank < ranks->count(); ++rank)
        EXPECT_EQ(all[rank], rank);
}

TEST(MpiRanks, AddUpAndCompare)
{
    std::uint64_t sums[] = {1, std::uint64_t{ranks->rank()} << 40};
    ranks->sum(sums);
    EXPECT_EQ(sums[0], ranks->count());
    EXPECT_EQ(sums[1], std::uint64_t{ranks->count()} * (ranks->count() - 1) / 2 << 40);
    float least[] = {-static_cast<float>(ranks->rank()), 3};
    ranks->least(least);
    EXPECT_EQ(least[0], -static_cast<float>(ranks->count() - 1));
    EXPECT_EQ(least[1], 3);
}

TEST(MpiRanks, ExchangeInPieces)
{
    for (int round = 0; round < 3; ++round) {
        std::vector<std::vector<uint>> to;
        for (uint rank = 0; rank < ranks->count(); ++rank)
            to.push_back(message(ranks->rank(), rank));
        const std::vector<std::vector<uint>> from = exchanged(*ranks, to);
        for (uint rank = 0; rank < ranks->count(); ++rank)
            EXPECT_EQ(from[rank], message(rank, ranks->rank()));
    }
}

TEST(MpiRanks, ExchangeNumbersManyTimesOver)
{
    for (std::uint64_t round = 0; round < 200; ++round) {
        std::vector<std::uint64_t> to(ranks->count());
        const auto number = [&](uint from, uint rank) {
            return (from + rank + round) % 3 == 0 ? 0 : (round << 32) + from * 1000 + rank;
        };
        for (uint rank = 0; rank < ranks->count(); ++rank)
            to[rank] = number(ranks->rank(), rank);
        const std::vector<std::uint64_t> from = ranks->exchanged(to);
        for (uint rank = 0; rank < ranks->count(); ++rank)
            EXPECT_EQ(from[rank], number(rank, ranks->rank())) << round;
    }
}

TEST(MpiRanks, ExchangeNothing)
{
    for (const std::vector<uint>& from :
         exchanged(*ranks, std::vector<std::vector<uint>>(ranks->count())))
        EXPECT_TRUE(from.empty());
}

}  // namespace
}  // namespace bvhbench

int main(int argc, char** argv)
{
    // Messages of several pieces. The argument "sparse" has sizes exchanged as among many ranks.
    const bool is_sparse = argc > 1 && std::string_view(argv[1]) == "sparse";
    return bvhbench::run_rank_tests(argc, argv, 1000, is_sparse ? 0 : 64);
}
