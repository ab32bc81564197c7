// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DLABEL_BITS=20
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DLABEL_BITS=32
//
// The front that tracking begins with: the roots of every two objects, be their boxes apart or not, and each root with
// itself. Roots that are apart stay in it, for else nobody would notice when objects meet.
#include "collide/walks/node_word.clh"

static inline uint root_word(FOREST_PARAMETERS, const uint object)
{
    PICK_TREE(object)
    return word_of(object, tree_root(TREE));
}

/// A work-item for each of object_count^2 pairs of objects, ordered; `front` has room for all that are wanted.
kernel void list_roots(FOREST_PARAMETERS, const uint object_count, const uint within,
                       const uint between, global uint2* front)
{
    const ulong count = object_count, all_between = count * (count - 1ul) / 2ul;
    const ulong a = get_global_id(0) / count, b = get_global_id(0) % count;
    if (a >= count || (a == b ? within == 0u : a > b || between == 0u))
        return;
    const ulong slot = a == b ? (between != 0u ? all_between : 0ul) + a
                              : a * (2ul * count - a - 1ul) / 2ul + (b - a - 1ul);
    front[slot] = (uint2)(root_word(FOREST, (uint)a), root_word(FOREST, (uint)b));
}
