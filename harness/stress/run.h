// SPDX-License-Identifier: MIT
#pragma once

#include "harness/stress/parts.h"

namespace bvhbench {

/// Everything: each family's scenes, each with builders, colliders and libraries; the parts that are no scenes after
/// them. What fails is a finding, and the run goes on.
void stress_all(Session& session, const StressTask& task, const AddStressCell& add);

}  // namespace bvhbench
