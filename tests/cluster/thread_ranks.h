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
        for (const Bytes& one : posted(std::vector(count(), Bytes(own.begin(), own.end()))))
            all.insert(all.end(), one.begin(), one.end());
        return all;
    }

    std::vector<std::uint64_t> exchanged(std::span<const std::uint64_t> to) override
    {
        std::vector<Bytes> bytes;
        for (const std::uint64_t& number : to)
            bytes.push_back(bytes_of(std::as_bytes(std::span(&number, 1))));
        std::vector<std::uint64_t> numbers;
        for (const Bytes& one : posted(std::move(bytes)))
            std::memcpy(&numbers.emplace_back(), one.data(), one.size());
        return numbers;
    }

    void exchange(std::span<const std::span<const std::byte>> to,
                  std::span<const std::span<std::byte>> from) override
    {
        std::vector<Bytes> bytes;
        for (const std::span<const std::byte> one : to)
            bytes.push_back(bytes_of(one));
        const std::vector<Bytes> got = posted(std::move(bytes));
        for (std::size_t rank = 0; rank < got.size(); ++rank)
            std::ranges::copy(got.at(rank), from[rank].begin());
    }

private:
    static Bytes bytes_of(std::span<const std::byte> bytes) { return {bytes.begin(), bytes.end()}; }

    std::vector<Bytes> posted(std::vector<Bytes> to)
    {
        meeting_.post[rank_] = std::move(to);
        wait_for_all();
        std::vector<Bytes> got(count());
        for (uint from = 0; from < count(); ++from)
            got[from] = meeting_.post[from][rank_];
        wait_for_all();
        return got;
    }

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
