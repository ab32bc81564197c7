// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=512u -DKEYS_PER_ITEM=16u -DCODE_WORDS=1u -DDIGIT_BITS=8u -DSTATE_EPOCH_BITS=31u -DMOST_TILES=144u -DFEW_TILES=16u -DPOST_ID_BITS=28u
// check: -DGROUP_SIZE=32u -DKEYS_PER_ITEM=3u -DCODE_WORDS=2u -DDIGIT_BITS=8u -DSTATE_EPOCH_BITS=31u -DMOST_TILES=1u -DFEW_TILES=16u -DPOST_ID_BITS=28u
//
// The passes of sweep.cl in one launch (at_once.clh).
#include "builders/stages/sort/at_once.clh"

/// Sorts the `count` codes of `codes`, whose ids are their positions, by `passes` digits. Writes the ids to `ids_out` and, with
/// `keeps_codes`, the codes to `codes_out`. `states` and `posts` are as in AtOnce, zero at first. Launched with one
/// group per tile, at most MOST_TILES. All groups must be resident. No earlier pass may have used the epochs `epoch` to
/// `epoch` + `passes` - 1.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void sort_at_once(
    global const Code* codes, global Code* codes_out, global uint* ids_out,
    volatile global ulong* states, volatile global ulong* posts, const uint count,
    const uint passes, const uint epoch, const uint keeps_codes)
{
    local AtOnceScratch scratch;
    const AtOnce all = {states, posts, count, passes, epoch, codes, codes_out, keeps_codes};
    const uint first = (uint)get_group_id(0) * TILE, here = min(TILE, count - first);
    OwnCodes own;
    uint ids[KEYS_PER_ITEM];
    load_codes(&own, codes, first, here);
    load_ids(ids, ids_out, first, here, true);
    sort_at_once_from(&own, ids, &scratch, all, ids_out);
}
