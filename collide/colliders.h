// SPDX-License-Identifier: MIT
//
// Every way to find pairs.
#pragma once

#include "collide/collider.h"

namespace bvhbench {

/// Each leaf walks the tree by itself, without a stack: only over what lies behind it, so each pair appears once.
std::unique_ptr<Collider> make_leaf(Programs& programs, const ColliderOptions& options);

/// The paper's traversal, Section 5: all pairs of nodes of a level before the next, in queues between launches.
std::unique_ptr<Collider> make_bvtt(Programs& programs, const ColliderOptions& options);

/// The cut through the tree of tests at which the last frame stopped, moved to where this one does: the tree's topology
/// stays, its boxes are refitted.
std::unique_ptr<Collider> make_front(Programs& programs, const ColliderOptions& options);

/// Neighbouring leaves as one query: their common box goes down the tree, and what it meets is tested against each.
std::unique_ptr<Collider> make_group(Programs& programs, const ColliderOptions& options);

/// Blocks of neighbouring leaves against blocks: their boxes go down an implicit tree, and where two meet, so do leaves.
std::unique_ptr<Collider> make_block(Programs& programs, const ColliderOptions& options);

/// No tree: every box entered into the cells it covers, of a grid of several levels that is hashed, sorted and
/// searched anew each frame.
std::unique_ptr<Collider> make_grid(Programs& programs, const ColliderOptions& options);

/// Sweep and prune on one core of the host, whatever the tree: the oracle.
std::unique_ptr<Collider> make_brute(Programs& programs, const ColliderOptions& options);

}  // namespace bvhbench
