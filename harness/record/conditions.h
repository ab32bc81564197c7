// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bvhbench {

/// Settings of the host that distort times. An empty value is unknown.
struct HostConditions {
    std::string governor;       ///< of the first core whose is not "performance", else that
    std::optional<bool> turbo;  ///< whether cores may clock higher for a while
    std::optional<bool> on_battery;
    std::optional<double> load;         ///< processes that wanted to run, mean of the last minute
    std::vector<std::string> warnings;  ///< sentences on those that matter

    bool operator==(const HostConditions&) const = default;
};

/// Read from /sys and /proc below `root`. `threads` is how many the host runs at once; a build of another type than Release
/// is one more thing to warn of.
HostConditions host_conditions(int threads, const std::string& build_type,
                               const std::filesystem::path& root = "/");

}  // namespace bvhbench
