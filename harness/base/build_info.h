// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace bvhbench {

/// Version, commit and compiler that this program was built with. cmake/BuildInfo.cmake fills it in at build time.
struct BuildInfo {
    const char* version;
    /// "unknown" when built outside the project's own repository and its archives.
    const char* commit;
    bool dirty;  ///< whether the commit is unknown, or files that the build reads differed from it
    std::vector<const char*> changed_files;  ///< these files, new ones too
    const char* compiler;
    const char* build_type;
    const char* arch;         ///< value of -march
    const char* source_root;  ///< source folder at build time; it may no longer exist
};

extern const BuildInfo build_info;

}  // namespace bvhbench
