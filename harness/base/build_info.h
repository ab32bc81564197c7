// SPDX-License-Identifier: MIT
#pragma once

namespace bvhbench {

/// What this program was made from. Filled in at build time by cmake/BuildInfo.cmake.
struct BuildInfo {
    const char* version;
    const char* commit;  ///< "unknown" when built outside a repository
    bool dirty;          ///< whether files differed from the commit
    const char* compiler;
    const char* build_type;
    const char* arch;         ///< value of -march
    const char* source_root;  ///< the folder it was built from, which may be gone
};

extern const BuildInfo build_info;

}  // namespace bvhbench
