// SPDX-License-Identifier: MIT
//
// Ranks: processes that work on one scene, each with a device of its own, and what they tell each other. Code of this room talks
// through this interface, so that tests can run ranks as threads, without MPI.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "geometry/dialect.h"

namespace bvhbench {

using Bytes = std::vector<std::byte>;

/// This process as one of `count()` ranks. All ranks must call the same functions in the same order. All functions but the first
/// two wait for the other ranks.
class Ranks {
public:
    virtual ~Ranks() = default;

    virtual uint rank() const = 0;   ///< of this process, from 0 on
    virtual uint count() const = 0;  ///< at least 1

    /// Waits until all ranks have called it.
    virtual void wait_for_all() = 0;

    /// Replaces each value by its sum over all ranks. All ranks pass equally many values.
    virtual void sum(std::span<std::uint64_t> values) = 0;

    /// Replaces each value by the least of all ranks.
    virtual void least(std::span<float> values) = 0;

    /// Returns the bytes of all ranks, one after the other. All ranks pass equally many.
    virtual Bytes gathered(std::span<const std::byte> own) = 0;

    /// Tells each rank r the number `to[r]`. Returns what each rank told this one, by rank.
    virtual std::vector<std::uint64_t> exchanged(std::span<const std::uint64_t> to) = 0;

    /// Sends `to[r]` to rank r and fills `from[r]` with what rank r sends to this one: as many bytes as that rank sends. Any number
    /// of bytes, none included; none to itself.
    virtual void exchange(std::span<const std::span<const std::byte>> to,
                          std::span<const std::span<std::byte>> from) = 0;
};

/// Returns the values of all ranks, one rank after the other. All ranks pass equally many.
template <class T>
std::vector<T> gathered(Ranks& ranks, std::span<const T> own)
{
    static_assert(std::is_trivially_copyable_v<T>, "messages are plain bytes");
    const Bytes bytes = ranks.gathered(std::as_bytes(own));
    std::vector<T> all(bytes.size() / sizeof(T));
    if (!all.empty())
        std::memcpy(all.data(), bytes.data(), bytes.size());
    return all;
}

/// Sends the values `to[r]` to rank r. Returns those that were sent to this rank, by rank.
template <class T>
std::vector<std::vector<T>> exchanged(Ranks& ranks, std::vector<std::vector<T>> to)
{
    static_assert(std::is_trivially_copyable_v<T>, "messages are plain bytes");
    assert(to.size() == ranks.count());
    std::vector<std::vector<T>> from(to.size());
    from[ranks.rank()] = std::move(to[ranks.rank()]);
    to[ranks.rank()].clear();
    std::vector<std::uint64_t> counts;
    for (const std::vector<T>& values : to)
        counts.push_back(values.size());
    counts = ranks.exchanged(counts);
    std::vector<std::span<const std::byte>> sent;
    std::vector<std::span<std::byte>> received;
    for (std::size_t rank = 0; rank < to.size(); ++rank) {
        if (rank != ranks.rank())
            from[rank].resize(counts[rank]);
        sent.push_back(std::as_bytes(std::span(to[rank])));
        received.push_back(rank == ranks.rank() ? std::span<std::byte>()
                                                : std::as_writable_bytes(std::span(from[rank])));
    }
    ranks.exchange(sent, received);
    return from;
}

/// Sends the values of `to`, in which `counts[r]` values for rank r follow those for the ranks before it; none to itself. Fills `from`
/// with the values that all others sent to this one, by rank.
template <class T>
void exchange_by_rank(Ranks& ranks, std::span<const T> to, std::span<const std::uint64_t> counts,
                      std::vector<T>& from)
{
    static_assert(std::is_trivially_copyable_v<T>, "messages are plain bytes");
    assert(counts.size() == ranks.count() && counts[ranks.rank()] == 0);
    const std::vector<std::uint64_t> coming = ranks.exchanged(counts);
    from.resize(std::reduce(coming.begin(), coming.end()));
    std::vector<std::span<const std::byte>> sent;
    std::vector<std::span<std::byte>> received;
    std::span<T> room = from;
    for (std::size_t rank = 0; rank < counts.size(); ++rank) {
        sent.push_back(std::as_bytes(to.first(counts[rank])));
        received.push_back(std::as_writable_bytes(room.first(coming[rank])));
        to = to.subspan(counts[rank]);
        room = room.subspan(coming[rank]);
    }
    ranks.exchange(sent, received);
}

constexpr uint first_rank = 0;  ///< gathers what all ranks have found

/// Sends values of every rank to the first, which gets them by rank; the others get none.
template <class T>
std::vector<std::vector<T>> at_first(Ranks& ranks, std::vector<T> own)
{
    std::vector<std::vector<T>> to(ranks.count());
    to[first_rank] = std::move(own);
    return exchanged(ranks, std::move(to));
}

/// Returns the values of all ranks at the first, one rank after the other, and none elsewhere.
template <class T>
std::vector<T> all_at_first(Ranks& ranks, std::vector<T> own)
{
    std::vector<T> all;
    for (std::vector<T>& of_rank : at_first(ranks, std::move(own))) {
        all.insert(all.end(), of_rank.begin(), of_rank.end());
        of_rank = {};
    }
    return all;
}

}  // namespace bvhbench
