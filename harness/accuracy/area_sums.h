// SPDX-License-Identifier: MIT
//
// The surface area cost of a tree, summed in several ways: those that may be chosen, and one to hold them to.
#pragma once

#include <span>
#include <string_view>

#include "builders/tree.h"

namespace bvhbench {

struct SumMethod {
    std::string_view name;
    std::string_view summary;
    double (*cost)(
        const HostTree& tree);  ///< with the usual node costs; of a root that has an area
    bool is_ours = false;       ///< what the counter sah_cost is made by
};

/// In the order of tables.
std::span<const SumMethod> sum_methods();

/// The reference: areas and sums in long double, 64 bits of mantissa on x86.
long double cost_in_long_double(const HostTree& tree);

}  // namespace bvhbench
