// SPDX-License-Identifier: MIT
#pragma once

namespace bvhbench {

/// C_inner and C_tri of Aila, Karras and Laine 2013, Eq. (1): what visiting a node and testing a triangle cost,
/// relative to each other. The paper prints none; with theirs, which these are, its Table 4 comes out.
struct NodeCosts {
    double inner = 1.2;
    double triangle = 1.0;

    bool operator==(const NodeCosts&) const = default;
};

}  // namespace bvhbench
