// SPDX-License-Identifier: MIT
//
// Answers of oracles, kept from run to run in the user's cache folder: facts that identify a list, not the list.
#pragma once

#include <cstdint>
#include <optional>

#include "collide/pairs.h"

namespace bvhbench {

/// Facts of the right list of pairs or contacts of a frame.
struct AnswerFacts {
    PairFacts set;
    /// PairList::hash() of the list, with triangles numbered as in the scene's file.
    std::uint64_t file_hash = 0;
    std::uint64_t touching = 0;  ///< of a list of contacts: those that only touch

    bool operator==(const AnswerFacts&) const = default;
};

/// Returns the facts kept under `key`, the hash of all that the answer depends on. A file that is damaged, or that has another key
/// or format, counts as none.
std::optional<AnswerFacts> kept_answer(std::uint64_t key);

/// Keeps the facts for later runs. Answers of fewer pairs than an oracle lists at once are not kept. The folder is emptied first if
/// it has too many files. Files that cannot be written are not kept; other processes may write the same ones.
void keep_answer(std::uint64_t key, const AnswerFacts& facts);

}  // namespace bvhbench
