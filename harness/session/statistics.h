// SPDX-License-Identifier: MIT
//
// What the stopping rule, the search for tuned values and drift go by. Result files keep samples; whoever reads them computes his
// own statistics.
#pragma once

#include <vector>

#include "device/queue.h"

namespace bvhbench {

/// The value a `fraction` of the sorted values lies below, between neighbours in proportion. 0 for none.
double quantile(std::vector<double> values, double fraction);

/// Nanoseconds of all stages of a sample: on the device from the first start to the last end; stages on the host are added.
double whole_ns(const std::vector<StageTime>& stages);

}  // namespace bvhbench
