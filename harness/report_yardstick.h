// SPDX-License-Identifier: MIT
//
// How near kernels are to plain code of the host. Printed from a run that measured both.
#pragma once

#include <string>

#include "harness/record.h"

namespace bvhbench {

/// The stage hierarchy of each builder that leaves oibvh-host's tree, beside oibvh-host's own of the same run: medians
/// and their ratio. Empty if the run has no such pair with a right answer each.
std::string yardstick_report(const Document& document);

}  // namespace bvhbench
