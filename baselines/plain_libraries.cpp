// SPDX-License-Identifier: MIT
#include "baselines/plain_libraries.h"

namespace bvhbench {

std::span<const PlainLibrary> plain_libraries()
{
    static const std::vector<PlainLibrary> all = [] {
        std::vector<PlainLibrary> found;
#if BVHBENCH_HAS_EMBREE
        for (const PlainLibrary& library : plain_embree())
            found.push_back(library);
#endif
#if BVHBENCH_HAS_FCL
        for (const PlainLibrary& library : plain_fcl())
            found.push_back(library);
#endif
        return found;
    }();
    return all;
}

}  // namespace bvhbench
