// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "process/temporary_folder.h"

namespace bvhbench {

/// Returns the folder of this program's files called `of` below $XDG_CACHE_HOME or ~/.cache; empty if there is no home folder, which
/// is not made: Debian gives users without one the name of none. The returned folder need not exist.
std::filesystem::path cache_folder(const char* of);

/// A writable folder in which PoCL keeps compiled kernels for the lifetime of this object.
///
/// PoCL ends the process if it cannot write its folder. Therefore the constructor chooses a usable folder, before the first
/// OpenCL call. If there is none, it makes a temporary folder, which the destructor removes. Our own folder is emptied when it is
/// too large. A folder named by POCL_CACHE_DIR is checked but never emptied.
class PoclCache {
public:
    /// Prints one sentence on stderr if kernels cannot be kept. Throws Unavailable if there is no usable folder at all.
    PoclCache();
    ~PoclCache();

private:
    void share(const std::filesystem::path& folder);
    void take_temporary(const std::string& why);

    std::optional<TemporaryFolder> temporary_;
    int lock_ = -1;  ///< shared lock while our folder is used, exclusive while it is emptied
};

}  // namespace bvhbench
