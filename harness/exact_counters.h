// SPDX-License-Identifier: MIT
//
// Which counters of a cell are the same whenever it is measured, and which way they get worse.
#pragma once

#include <string_view>

#include "harness/record.h"

namespace bvhbench {

/// A counter of a pipeline that comes out a little different from run to run, although nothing was changed.
struct UnsteadyCounter {
    std::string_view counter;
    std::string_view collider;
    std::string_view why;
};

/// All there are. Anything else that is no time is compared exactly.
std::span<const UnsteadyCounter> unsteady_counters();

/// Whether the end of its name is a unit of time or a rate: _ns, _us, _ms, _s or _per_s.
bool is_time(std::string_view counter);

/// Whether a cell like `cell` has the same value in every run.
bool is_exact(std::string_view counter, const Cell& cell);

/// Whether it is another on a device with other properties, such as its number of compute units, though exact on each.
bool depends_on_machine(std::string_view counter);

/// Whether a smaller value is known to be better: costs, errors and bytes. What was found has no better value.
bool is_better_smaller(std::string_view counter);

}  // namespace bvhbench
