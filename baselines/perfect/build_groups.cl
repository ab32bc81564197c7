// SPDX-License-Identifier: MIT
//
// Algorithm 1 over the padded perfect tree, one work-group per subtree. LEVELS = log2(2 GROUP_SIZE ITEMS).
// check: -DGROUP_SIZE=256u -DITEMS=1u -DLEVELS=9u
#include "baselines/perfect/levels.clh"

#include "builders/implicit/build_groups.clh"
