// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "cluster/ranks.h"

namespace bvhbench {

/// Another rank failed, so that this one cannot go on.
struct OtherRankFailed {};

/// Ranks that hear of each other's failures, so that none waits for one that has failed. Before each message all ranks tell whether
/// they go on, which is one sum more. If one does not, the others throw OtherRankFailed in place of the message.
class AgreeingRanks final : public Ranks {
public:
    explicit AgreeingRanks(Ranks& ranks) : ranks_(ranks) {}

    /// Tells whether this rank has failed. Returns whether any has. A rank calls this once when it has failed, where others go on to
    /// their next message, and when its work is done. Throws nothing.
    bool any_failed(bool has_failed)
    {
        std::array<std::uint64_t, 1> failed{has_failed ? 1u : 0u};
        ranks_.sum(failed);
        return failed[0] != 0;
    }

    uint rank() const override { return ranks_.rank(); }
    uint count() const override { return ranks_.count(); }
    void wait_for_all() override { agree(); }
    void sum(std::span<std::uint64_t> values) override { agree().sum(values); }
    void least(std::span<float> values) override { agree().least(values); }
    Bytes gathered(std::span<const std::byte> own) override { return agree().gathered(own); }
    std::vector<std::uint64_t> exchanged(std::span<const std::uint64_t> to) override
    {
        return agree().exchanged(to);
    }
    void exchange(std::span<const std::span<const std::byte>> to,
                  std::span<const std::span<std::byte>> from) override
    {
        agree().exchange(to, from);
    }

private:
    Ranks& agree()
    {
        if (any_failed(false))
            throw OtherRankFailed();
        return ranks_;
    }

    Ranks& ranks_;
};

}  // namespace bvhbench
