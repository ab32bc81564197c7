// SPDX-License-Identifier: MIT
#pragma once

namespace bvhbench {

/// Give PoCL a folder of our own to keep compiled kernels in, unless POCL_CACHE_DIR is set, and remove what
/// earlier processes forgot there. Call before the first OpenCL call; does nothing where there is no home. Throws
/// Unavailable when that folder is there and cannot be written.
void prepare_pocl_cache();

}  // namespace bvhbench
