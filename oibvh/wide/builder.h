// SPDX-License-Identifier: MIT
#pragma once

#include "builders/builder.h"
#include "oibvh/wide/tree.h"

namespace bvhbench {

/// A builder of Appendix C's trees, bottom-up in several launches, by kernels that suit the kind of device. `sorted_leaves`
/// changes nothing: nodes hold the leaves' boxes in leaf order.
std::unique_ptr<Builder> make_wide_builder(Programs& programs, const BuilderCard& card,
                                           const WideFormat& format, const BuildOptions& options);

}  // namespace bvhbench
