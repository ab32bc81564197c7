// SPDX-License-Identifier: MIT
#include "device/host_memory.h"

#include <fstream>
#include <string>

namespace bvhbench {

std::optional<std::size_t> available_host_memory()
{
    std::ifstream file("/proc/meminfo");
    for (std::string key; file >> key;) {
        std::size_t kib = 0;
        if (key == "MemAvailable:" && file >> kib)
            return kib * 1024 / 10 * 9;
        file.ignore(256, '\n');
    }
    return std::nullopt;
}

}  // namespace bvhbench
