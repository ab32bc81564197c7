// SPDX-License-Identifier: MIT
//
// Bytes that a query must move and that are known only once it has run: docs/measuring.md, Bytes moved.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "builders/input.h"
#include "collide/pairs.h"
#include "device/queue.h"

namespace bvhbench {

/// Bytes of the faces and points of all triangles that are in `pairs`, each once: what deciding about them must read.
std::int64_t corner_bytes(std::span<const Pair> pairs, const Input& input);

/// Add to what the launches of `stage` have declared, if it is there and has any.
void add_moved_bytes(std::vector<StageTime>& stages, std::string_view stage, std::int64_t bytes);

}  // namespace bvhbench
