// SPDX-License-Identifier: MIT
#include "scenes/memory.h"

#include <unistd.h>

#include <algorithm>

#include "geometry/error.h"
#include "scenes/formats/text.h"

namespace bvhbench {

void check_memory(std::string_view scene, std::uint64_t bytes, std::uint64_t limit)
{
    const auto there = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                       static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    const std::uint64_t given = limit == 0 ? there : std::min(limit, there);
    if (bytes > given)
        throw Unavailable("scene " + in_quotes(scene) + " takes about " +
                          std::to_string(bytes >> 20) + " MiB of memory, and " +
                          (given == there ? "this machine has " : "the limit is ") +
                          std::to_string(given >> 20));
}

}  // namespace bvhbench
