// SPDX-License-Identifier: MIT
//
// Ranks that are threads of the test's process.
#pragma once

#include <algorithm>
#include <barrier>
#include <functional>
#include <thread>
#include <vector>

#include "cluster/ranks.h"

namespace bvhbench {

/// What the threads share: one post box for each pair of ranks.
struct Meeting {
    explicit Meeting(uint count) : barrier(static_cast<int>(count)), post(count)
    {
        for (std::vector<Bytes>& of_rank : post)
            of_rank.resize(count);
    }
    std::barrier<> barrier;
    std::vector<std::vector<Bytes>> post;  ///< [from][to]
};

class ThreadRanks final : public Ranks {
public:
    ThreadRanks(uint rank, Meeting& meeting) : rank_(rank), meeting_(meeting) {}

    uint rank() const override { return rank_; }
    uint count() const override { return static_cast<uint>(meeting_.post.size()); }
    void wait_for_all() override { meeting_.barrier.arrive_and_wait(); }

    void sum(std::span<std::uint64_t> values) override
    {
        joined(values, [](std::uint64_t a, std::uint64_t b) { return a + b; });
    }
    void least(std::span<float> values) override
    {
        joined(values, [](float a, float b) { return std::min(a, b); });
    }

    Bytes gathered(std::span<const std::byte> own) override
    {
        Bytes all;
        for (const Bytes& one : exchanged(std::vector(count(), Bytes(own.begin(), own.end()))))
            all.insert(all.end(), one.begin(), one.end());
        return all;
    }

    std::vector<Bytes> exchanged(std::vector<Bytes> to) override
    {
        meeting_.post[rank_] = std::move(to);
        wait_for_all();
        std::vector<Bytes> got(count());
        for (uint from = 0; from < count(); ++from)
            got[from] = meeting_.post[from][rank_];
        wait_for_all();
        return got;
    }

private:
    template <class T, class Join>
    void joined(std::span<T> values, const Join& join)
    {
        const std::vector<T> all =
            bvhbench::gathered<T>(*this, std::span<const T>(values.data(), values.size()));
        for (std::size_t k = 0; k < values.size(); ++k) {
            values[k] = all[k];
            for (std::size_t other = k + values.size(); other < all.size(); other += values.size())
                values[k] = join(values[k], all[other]);
        }
    }

    uint rank_;
    Meeting& meeting_;
};

/// Runs `work` once for each of `count` ranks, at the same time.
inline void on_ranks(uint count, const std::function<void(Ranks&)>& work)
{
    Meeting meeting(count);
    std::vector<std::jthread> threads;
    for (uint rank = 0; rank < count; ++rank)
        threads.emplace_back([&, rank] {
            ThreadRanks ranks(rank, meeting);
            work(ranks);
        });
}

}  // namespace bvhbench
