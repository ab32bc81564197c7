// SPDX-License-Identifier: MIT
#include "baselines/plain_libraries.h"

namespace bvhbench {

std::span<const PlainLibrary> plain_libraries()
{
    static const std::vector<PlainLibrary> all = {
#if BVHBENCH_HAS_EMBREE
        {"rtcCollide", "Embree", false, plain_embree},
#endif
#if BVHBENCH_HAS_FCL
        {"FCL AABB double", "FCL", true, plain_fcl_aabb_double},
        {"FCL OBBRSS double", "FCL", true, plain_fcl_obbrss_double},
        {"FCL AABB float", "FCL", true, plain_fcl_aabb_float},
        {"FCL OBBRSS float", "FCL", true, plain_fcl_obbrss_float},
#endif
    };
    return all;
}

}  // namespace bvhbench
