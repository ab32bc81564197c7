// SPDX-License-Identifier: MIT
//
// Everything the paper's builders are compared with.
#pragma once

#include <memory>

#include "builders/builder.h"

namespace bvhbench {

/// The perfect implicit tree, padded to a power of two leaves: Table 1's first row.
std::unique_ptr<Builder> make_perfect(Programs& programs, const BuildOptions& options);

}  // namespace bvhbench
