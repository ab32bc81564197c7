// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace bvhbench {

/// Which sizes a scene of an experiment is wanted in; the union of what is set.
struct SizeRange {
    std::vector<std::int64_t> listed;
    std::int64_t from = 1, to = 0;  ///< every number
    std::int64_t powers_of_two_from = 1, powers_of_two_to = 0;
    std::int64_t around_powers_of_two_to =
        0;  ///< one below, at and above each power of two up to it
};

/// The sizes, ascending, each once, none below 1.
std::vector<std::int64_t> sizes_in(const SizeRange& range);

/// `pattern` with "{key}" replaced by each size. Throws BadUsage if it is not in there.
std::vector<std::string> scenes_in(const std::string& pattern, const std::string& key,
                                   const SizeRange& range);

}  // namespace bvhbench
