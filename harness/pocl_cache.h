// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "harness/interrupt.h"

namespace bvhbench {

/// Where PoCL keeps compiled kernels while this is there: a folder of ours that can be written and holds nothing broken.
///
/// PoCL ends the process over a folder that it cannot write, and over a file in it that is not whole. So before the
/// first OpenCL call a folder is found that will do, else an empty one below the folder of temporary files, removed in
/// the end; and what is in ours is held to seals (harness/cache_seals.h). A folder that POCL_CACHE_DIR names is
/// somebody else's: it is only asked whether it will do.
class PoclCache {
public:
    /// Says in one sentence on stderr when kernels cannot be kept. Throws Unavailable where there is no room at all.
    PoclCache();
    ~PoclCache();
    PoclCache(const PoclCache&) = delete;
    PoclCache& operator=(const PoclCache&) = delete;

private:
    bool take(const std::filesystem::path& folder);
    void take_temporary(const std::string& why);

    std::filesystem::path ours_, temporary_;
    int lock_ =
        -1;  ///< held shared by all who use the folder, alone by who looks for what is broken
    std::optional<AtSignal> removed_;  ///< the temporary folder
};

/// Why a folder will not do to keep `bytes` in; empty if it will. Makes it if it is not there.
std::string folder_problem(const std::filesystem::path& folder, std::uintmax_t bytes);

}  // namespace bvhbench
