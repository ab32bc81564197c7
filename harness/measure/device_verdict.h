// SPDX-License-Identifier: MIT
#pragma once

#include "harness/measure/pipeline.h"
#include "harness/record/record.h"

namespace bvhbench {

/// Returns the number and the hash of the pairs of a pipeline's last frame, which stay on the device. Requires what
/// Pipeline::device_pairs does.
PairFacts facts_on_device(Session& session, Pipeline& pipeline);

/// Returns the verdict on the pairs of a pipeline's last frame that are too many to list on the host. They must have the same
/// 128-bit hash as those that another algorithm of the device finds, `grid` or, for grids, `leaf` over oibvh-multi; and 10,000
/// random triangles must have the pairs that brute force finds on the host. Throws Unavailable if memory is too small for that.
Check verdict_of_devices(Session& session, Pipeline& pipeline, const ColliderChoice& choice,
                         const Input& input);

}  // namespace bvhbench
