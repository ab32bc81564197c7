// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "builders/builder.h"

namespace bvhbench {

/// Algorithm 1 in several launches, within which work-groups do not interact; Appendix B plans the launches.
std::unique_ptr<Builder> make_oibvh_multi(Programs& programs, const BuildOptions& options);

/// The same as printed: a work-item has one node, and work-items of a group meet node by node through local atomics.
std::unique_ptr<Builder> make_oibvh_multi_printed(Programs& programs, const BuildOptions& options);

/// Algorithm 1 in one launch: above the subtrees of single groups, a few groups wait for the others where they may, else the last
/// group to arrive below a subtree builds it. Where groups may wait but there would be too many, as `make_oibvh_multi`.
std::unique_ptr<Builder> make_oibvh_single(Programs& programs, const BuildOptions& options);

/// The same as printed: above the subtrees, groups meet node by node through global atomics, and one work-item goes on.
std::unique_ptr<Builder> make_oibvh_single_printed(Programs& programs, const BuildOptions& options);

/// Appendix C: trees with 4 or 8 children per node; a node holds its children's boxes.
std::unique_ptr<Builder> make_oibvh_wide4(Programs& programs, const BuildOptions& options);
std::unique_ptr<Builder> make_oibvh_wide8(Programs& programs, const BuildOptions& options);

/// The same tree as oibvh-multi, with the hierarchy built by host threads: the reference time for kernels on a CPU.
std::unique_ptr<Builder> make_oibvh_host(Programs& programs, const BuildOptions& options);

/// A direct, slow implementation of the paper on one core: the oracle of the kernels.
std::unique_ptr<Builder> make_oibvh_reference(Programs& programs, const BuildOptions& options);

}  // namespace bvhbench
