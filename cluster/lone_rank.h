// SPDX-License-Identifier: MIT
#pragma once

#include "cluster/ranks.h"

namespace bvhbench {

/// The only rank of a run without others.
class LoneRank final : public Ranks {
public:
    uint rank() const override { return 0; }
    uint count() const override { return 1; }
    void wait_for_all() override {}
    void sum(std::span<std::uint64_t>) override {}
    void least(std::span<float>) override {}
    Bytes gathered(std::span<const std::byte> own) override { return {own.begin(), own.end()}; }
    std::vector<std::uint64_t> exchanged(std::span<const std::uint64_t> to) override
    {
        return {to.begin(), to.end()};
    }
    void exchange(std::span<const std::span<const std::byte>>,
                  std::span<const std::span<std::byte>>) override
    {}
};

}  // namespace bvhbench
