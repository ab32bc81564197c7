// SPDX-License-Identifier: MIT
//
// Algorithm 1 over the ostensibly-implicit layout, a work-item a subtree.
#include "oibvh/levels.clh"

#include "builders/implicit/build_items.clh"
