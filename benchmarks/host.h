// SPDX-License-Identifier: MIT
#pragma once

#include "benchmarks/iterations.h"

namespace bvhbench {

/// Registers code of the host that needs no device, under names that begin with "host/": the layout's formulas, Morton and Hilbert
/// codes, predicates of the narrow phase, readers of mesh files.
void add_host_benchmarks(Outcome& outcome);

}  // namespace bvhbench
