// SPDX-License-Identifier: MIT
#pragma once

#include "harness/options.h"
#include "harness/sweep/plan.h"

namespace bvhbench {

/// The sweep of the command's file, with what the command line says in place of its keys. Throws BadUsage, naming the file,
/// and Unavailable if that cannot be read.
Sweep sweep_described(const SweepCommand& command);

}  // namespace bvhbench
