// SPDX-License-Identifier: MIT
#include "scenes/memory.h"

#include <unistd.h>

#include "geometry/error.h"
#include "scenes/formats/text.h"

namespace bvhbench {

void check_memory(std::string_view scene, std::uint64_t bytes)
{
    const auto there = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                       static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    if (bytes > there)
        throw Unavailable("scene " + in_quotes(scene) + " takes about " +
                          std::to_string(bytes >> 20) + " MiB of memory, and this machine has " +
                          std::to_string(there >> 20));
}

}  // namespace bvhbench
