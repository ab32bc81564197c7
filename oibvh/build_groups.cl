// SPDX-License-Identifier: MIT
//
// Algorithm 1 over the ostensibly-implicit layout, a work-group per subtree. LEVELS = log2(2 GROUP_SIZE ITEMS).
// check: -DGROUP_SIZE=256u -DITEMS=1u -DLEVELS=9u -DFROM_LEAVES=1
// check: -DGROUP_SIZE=64u -DITEMS=4u -DLEVELS=9u -DSEVERAL_OBJECTS=1 -DFROM_LEAVES=1 -DLINES_UP=1
// check: -DGROUP_SIZE=64u -DITEMS=4u -DLEVELS=9u -DBOX_FORMAT=1u
// check: -DGROUP_SIZE=64u -DITEMS=4u -DLEVELS=9u -DBOX_FORMAT=3u
// check: -DGROUP_SIZE=64u -DITEMS=4u -DLEVELS=9u -DBOX_FORMAT=4u
#include "oibvh/levels.clh"

#include "builders/implicit/build_climbing.clh"
#include "builders/implicit/build_groups.clh"
#include "builders/implicit/build_meeting.clh"
#include "builders/implicit/build_upward.clh"
#include "builders/implicit/build_waiting.clh"
