// SPDX-License-Identifier: MIT
#pragma once

namespace bvhbench {

/// Version, commit and compiler that this program was built with. cmake/BuildInfo.cmake fills it in at build time.
struct BuildInfo {
    const char* version;
    const char* commit;  ///< "unknown" when built outside a repository
    bool dirty;          ///< whether files differed from the commit, untracked ones included
    const char* compiler;
    const char* build_type;
    const char* arch;         ///< value of -march
    const char* source_root;  ///< source folder at build time; it may no longer exist
};

extern const BuildInfo build_info;

}  // namespace bvhbench
