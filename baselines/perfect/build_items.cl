// SPDX-License-Identifier: MIT
//
// Algorithm 1 over the padded perfect tree, a work-item a subtree.
#include "baselines/perfect/levels.clh"

#include "builders/implicit/build_items.clh"
