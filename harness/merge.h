// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace bvhbench {

/// A result file that goes into a merged one.
struct MergePart {
    std::string origin;  ///< its name, for sentences about it
    std::string text;
};

/// What may differ between parts. Their formats may not.
struct MergeAllows {
    bool other_devices = false;
    bool other_commits = false;
};

struct Merged {
    std::string text;
    std::size_t cells = 0;
    std::size_t runs = 0;      ///< that they are from
    std::size_t repeated = 0;  ///< cells that were in several parts, the same in each
    bool differs = false;      ///< whether an answer is wrong
};

/// One result file of all cells of the parts, each once, as they were: in the order of the parts. Its `run` is the first
/// part's; `merged_from` tells of each run, and a cell's `run` which of them it is from.
///
/// Cells are the same if they are about the same builder or pipeline, with the same options, on the same frame and device.
/// Throws BadUsage if two that are the same have other contents, or parts differ in what they must not, Unavailable for a
/// part that is no result file.
Merged merge(std::span<const MergePart> parts, const MergeAllows& allows = {});

}  // namespace bvhbench
