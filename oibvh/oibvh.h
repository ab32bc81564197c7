// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "builders/builder.h"

namespace bvhbench {

/// Algorithm 1 with work-groups that meet only between launches; Appendix B plans the launches.
std::unique_ptr<Builder> make_oibvh_multi(Programs& programs, const BuildOptions& options);

/// Algorithm 1 in one launch: above a group's subtree, groups meet through global atomics.
std::unique_ptr<Builder> make_oibvh_single(Programs& programs, const BuildOptions& options);

/// Appendix C: trees of 4 or 8 children a node, a node holding its children's boxes.
std::unique_ptr<Builder> make_oibvh_wide4(Programs& programs, const BuildOptions& options);
std::unique_ptr<Builder> make_oibvh_wide8(Programs& programs, const BuildOptions& options);

/// The same tree, its hierarchy by plain threads of the host: the yardstick for kernels on a CPU.
std::unique_ptr<Builder> make_oibvh_host(Programs& programs, const BuildOptions& options);

/// The paper, slowly, on one core: the oracle for the kernels.
std::unique_ptr<Builder> make_oibvh_reference(Programs& programs, const BuildOptions& options);

}  // namespace bvhbench
