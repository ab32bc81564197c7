// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "harness/record.h"

namespace bvhbench {

/// Nanoseconds of all stages of a sample. On the device from the first start to the last end, as far as files before
/// format 1.4 tell when stages started; stages on the host are added.
double whole_ns(const std::vector<StageTime>& stages);

/// The samples that statistics are made of: those that no drift was near, unless these are fewer than half.
std::vector<const Sample*> counted_samples(const std::vector<Sample>& samples);

}  // namespace bvhbench
