// SPDX-License-Identifier: MIT
//
// The perfect implicit tree: every level stored in full, so that node i is in slot i. Padding, up to half of
// the memory, buys the simplest address there is. Table 1's first row; Eq. (2).
#ifndef BVHBENCH_BASELINES_PERFECT_LAYOUT_H
#define BVHBENCH_BASELINES_PERFECT_LAYOUT_H

#include "geometry/bits.h"

SHARED_BEGIN

/// Nodes of a level, used or padding. It does not depend on the leaves.
SHARED_FN uint perfect_stored_on(uint level) { return 1u << level; }

/// Slot of a level's leftmost node, which is also its implicit index.
SHARED_FN uint perfect_first_slot(uint level) { return (1u << level) - 1u; }

SHARED_END

#endif
