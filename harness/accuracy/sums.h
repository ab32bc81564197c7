// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "builders/tree.h"

namespace bvhbench {

/// A way to sum the surface area cost of a tree.
struct SumMethod {
    std::string_view name;
    /// With the usual node costs; of a root that has an area.
    double (*cost)(const HostTree& tree);
    bool is_ours = false;  ///< what the counter sah_cost is made by
};

/// In the order of tables.
std::span<const SumMethod> sum_methods();

/// The reference: areas and sums in long double, 64 bits of mantissa on x86.
long double cost_in_long_double(const HostTree& tree);

}  // namespace bvhbench
