// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "harness/record.h"

namespace bvhbench {

/// What finds pairs of swept boxes: a collider, over whose trees.
std::string swept_method(const BuilderChoice& builder, const ColliderChoice& collider);

/// Queries of swept boxes of a run that are of such an operation, a line each, and one for both of a step by the same pipeline: pairs, time, pairs a
/// second, pairs of the ground truth with those missed, and how many pairs there are for each of it. Empty if the run has
/// none.
std::string swept_report(const Document& document, Operation operation = Operation::collide);

}  // namespace bvhbench
