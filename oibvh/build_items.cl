// SPDX-License-Identifier: MIT
//
// Algorithm 1 over the ostensibly-implicit layout, a work-item per subtree.
// check: -DFROM_LEAVES=1 -DSEVERAL_OBJECTS=1
// check: -DBOX_FORMAT=1u
// check: -DBOX_FORMAT=4u
#include "oibvh/levels.clh"

#include "builders/implicit/build_items.clh"
