// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace bvhbench {

/// Options that all commands have.
struct CommonOptions {
    std::string device;   ///< words or an index; empty: the first CPU, else the first device
    std::string kernels;  ///< a source tree to read kernels from; empty: those in the program
    std::string data;     ///< the folder of data sets; empty: BVHBENCH_DATA
    std::string doubles = "recentred";  ///< a doubles_name, for coordinates that floats cannot hold
    /// The folder of tuned values; empty: none; not given: BVHBENCH_TUNING.
    std::optional<std::string> tuning;
    std::size_t memory_limit = 0;  ///< bytes of this process, and of the device; 0: what there is
    double time_limit_s = 600;     ///< of a single build or query; 0: none
    bool force = false;            ///< whether earlier files are replaced
    bool quiet = false;            ///< whether tables of results are left out
    bool verbose = false;
};

}  // namespace bvhbench
