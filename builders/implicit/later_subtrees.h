// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "builders/implicit/later_subtree.h"
#include "builders/implicit/schedule.h"

namespace bvhbench {

/// What later rounds build, round by round and object by object; `schedules` are of `objects`.
std::vector<LaterSubtree> later_subtrees(std::span<const uint> objects,
                                         std::span<const SubtreeSchedule> schedules);

}  // namespace bvhbench
