// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cassert>
#include <cstdint>
#include <vector>

#include "geometry/dialect.h"

namespace bvhbench {

/// Some of a scene's vertices, and the place of each in their ascending order. Takes one and a half bits for each vertex between
/// the least and the greatest.
class VertexNumbers {
public:
    /// Holds no vertex yet; all must be within `least` and `most`.
    VertexNumbers(uint least, uint most) : least_(least), words_((most - least) / 64 + 1) {}

    void add(uint vertex) { words_[word_of(vertex)] |= bit_of(vertex); }

    /// Returns all vertices, ascending. Called once, after the last `add`.
    std::vector<uint> numbered()
    {
        before_.reserve(words_.size());
        uint count = 0;
        for (const std::uint64_t word : words_) {
            before_.push_back(count);
            count += static_cast<uint>(std::popcount(word));
        }
        std::vector<uint> all;
        all.reserve(count);
        for (std::size_t k = 0; k < words_.size(); ++k)
            for (std::uint64_t rest = words_[k]; rest != 0; rest &= rest - 1)
                all.push_back(static_cast<uint>(least_ + 64 * k) +
                              static_cast<uint>(std::countr_zero(rest)));
        return all;
    }

    /// Returns the place of a vertex that was added. Called after `numbered`.
    uint place(uint vertex) const
    {
        const std::size_t word = word_of(vertex);
        assert((words_[word] & bit_of(vertex)) != 0);
        return before_[word] +
               static_cast<uint>(std::popcount(words_[word] & (bit_of(vertex) - 1)));
    }

private:
    std::size_t word_of(uint vertex) const { return (vertex - least_) / 64; }
    std::uint64_t bit_of(uint vertex) const { return std::uint64_t{1} << (vertex - least_) % 64; }

    uint least_;
    std::vector<std::uint64_t> words_;
    std::vector<uint> before_;  ///< vertices in the words before each word
};

}  // namespace bvhbench
