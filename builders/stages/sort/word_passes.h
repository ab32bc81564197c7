// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geometry/bits.h"

namespace bvhbench {

/// A launch of sweep_words.cl, which has the values of READS, WRITES and IF_RUNS.
struct WordPass {
    enum class Reads : uint { words, codes, low_parts, high_parts };
    enum class Writes : uint { words, ids, narrowed_words, high_parts };
    enum class IfRuns : uint { are_of_any_length, are_short, are_long };

    uint pass;        ///< Of its digit.
    uint first_pass;  ///< Of the lowest digit in the words that it reads.
    Reads reads;
    Writes writes;
    IfRuns if_runs;
    bool is_narrow;  ///< Words that it reads have 32 bits.
    uint moved;      ///< Words of 32 bits, read and written for each pair; 0 if seldom needed.
};

/// Passes by the high parts of codes of 64 bits, of at most 32 bits, which fit beside an id.
inline constexpr uint high_passes = 4;

/// Returns the passes over codes of `bits` bits, at most 32, with digits of `digit_bits`. Words become narrow as soon as the digits that are
/// left fit beside an id of `id_bits`.
std::vector<WordPass> narrowing_passes(uint bits, uint digit_bits, uint id_bits);

/// Returns the passes over codes of 64 bits with `passes` digits: high_passes by their high parts, before sort_runs.cl, and then those by
/// all digits for the case that runs are long.
std::vector<WordPass> passes_of_parts(uint passes);

}  // namespace bvhbench
