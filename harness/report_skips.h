// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "harness/record.h"

namespace bvhbench {

/// What each rule of collide/skips.h saves: of every frame that was measured with all rules and with one of them
/// switched off, the work that is left out, the time, and whether the same was found. Empty if there is none.
std::string skips_report(const Document& document);

}  // namespace bvhbench
