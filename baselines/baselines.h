// SPDX-License-Identifier: MIT
//
// Everything the paper's builders are compared with.
#pragma once

#include <memory>

#include "builders/builder.h"

namespace bvhbench {

/// The perfect implicit tree, padded to a power of two leaves: Table 1's first row.
std::unique_ptr<Builder> make_perfect(Programs& programs, const BuildOptions& options);

/// On one core of the host, from the root down, one triangle a leaf. They take no order: no code is computed.
std::unique_ptr<Builder> make_heap_median(Programs& programs, const BuildOptions& options);
std::unique_ptr<Builder> make_median_split(Programs& programs, const BuildOptions& options);
std::unique_ptr<Builder> make_sah_binned(Programs& programs, const BuildOptions& options);

}  // namespace bvhbench
