// SPDX-License-Identifier: MIT
//
// Is rebuilding faster than refitting? Printed from a run that measured both.
#pragma once

#include <string>

#include "harness/record.h"

namespace bvhbench {

/// Each builder's rebuild beside its refit on each scene: whole, and the one stage in which they differ; and what
/// the two trees cost. Empty if the run has no builder with times of both.
std::string refit_report(const Document& document);

}  // namespace bvhbench
