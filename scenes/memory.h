// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace bvhbench {

/// Throws Unavailable when `scene`, as the user typed it, takes more `bytes` than this machine has, or than `limit`
/// unless that is 0. Linux promises more memory than there is and ends the process that uses it, so it is counted
/// first.
void check_memory(std::string_view scene, std::uint64_t bytes, std::uint64_t limit = 0);

}  // namespace bvhbench
