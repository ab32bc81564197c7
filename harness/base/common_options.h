// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace bvhbench {

/// Options that every command has.
struct CommonOptions {
    std::string device;   ///< words of its name or an index; empty: first CPU, else first device
    std::string kernels;  ///< source tree of kernels; empty: BVHBENCH_KERNELS, else embedded
    std::string data;     ///< folder of data sets; empty: BVHBENCH_DATA
    std::string doubles = "recentred";  ///< a doubles_name: how doubles become floats
    bool weld = false;                  ///< whether vertices of equal position are joined
    std::string clock = "device";       ///< or "host": whose clock times stages on the device
    /// Folder of tuned values; empty: no tuned values; not set: BVHBENCH_TUNING, else the embedded values.
    std::optional<std::string> tuning;
    std::vector<std::string> plugins;   ///< shared libraries with builders and colliders
    std::vector<std::string> programs;  ///< programs with builders and colliders
    std::size_t memory_limit = 0;  ///< bytes, of the process and of the device; 0: what there is
    double time_limit_s = 600;     ///< for a single build, query or oracle; 0: no limit
    bool force = false;            ///< whether existing files may be replaced
    bool quiet = false;            ///< whether tables of results are not printed
    bool wide = false;             ///< whether tables may be wider than the terminal
    bool verbose = false;
    std::vector<std::string> given = {};  ///< those that were given, as words for ranks
};

/// Returns the text of an environment variable; empty if it is not set.
inline std::string environment(const char* variable)
{
    const char* const text = std::getenv(variable);
    return text == nullptr ? "" : text;
}

}  // namespace bvhbench
