// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "harness/base/interrupt.h"

namespace bvhbench {

/// Where PoCL keeps compiled kernels while this object exists: a folder that can be written.
///
/// PoCL ends the process over a folder that it cannot write. So before the first OpenCL call a folder is found that will do,
/// else an empty one below the folder of temporary files, which is removed in the end. Our own folder is emptied when it has
/// grown too large. A folder that POCL_CACHE_DIR names is somebody else's: it is only asked whether it will do.
class PoclCache {
public:
    /// Says in one sentence on stderr when kernels cannot be kept. Throws Unavailable where there is no room at all.
    PoclCache();
    ~PoclCache();
    PoclCache(const PoclCache&) = delete;
    PoclCache& operator=(const PoclCache&) = delete;

private:
    void share(const std::filesystem::path& folder);
    void take_temporary(const std::string& why);

    std::filesystem::path temporary_;
    int lock_ = -1;  ///< held shared by all who use our folder, alone while it is emptied
    std::optional<AtSignal> removed_;  ///< the temporary folder
};

}  // namespace bvhbench
