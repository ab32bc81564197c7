// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "harness/record.h"

namespace bvhbench {

/// Whole frames of a run by scene and pipeline: the mean over frames of their medians, with its deviation, memory,
/// pairs, contacts and the largest queue; below each scene what the paper prints in `table`, "table2" or "table3", or
/// nothing for another word. Empty if the run has no frames.
std::string frames_table(const Document& document, std::string_view table = {});

}  // namespace bvhbench
