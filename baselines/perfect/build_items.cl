// SPDX-License-Identifier: MIT
//
// Algorithm 1 over the padded perfect tree, one work-item per subtree.
#include "baselines/perfect/levels.clh"

#include "builders/implicit/build_items.clh"
