// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace bvhbench {

/// What is known of a run only when it ends.
struct EndOfRun {
    std::int64_t compile_ns = 0;
    std::vector<std::string> turns_with = {};  ///< ids of the runs that this run took turns with
    /// Mean number of them that wanted to run between samples.
    std::optional<double> other_processes = {};
};

}  // namespace bvhbench
