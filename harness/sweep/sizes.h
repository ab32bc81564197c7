// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace bvhbench {

/// Numbers of triangles as they are written by hand, ascending, each once: "1000:1000000:x10" is 1000, 10000 and on up to
/// the second number, each ten times the one before; "1000:5000:+1000" goes on by sums; "1000,30000" and "500" are those.
/// Factors may be broken: "1000:64000:x1.5". All of these may stand in a list. Throws BadUsage.
std::vector<std::int64_t> sizes_called(const std::string& text);

}  // namespace bvhbench
