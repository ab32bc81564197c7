// SPDX-License-Identifier: MIT
// check:
//
// What identifies a set of pairs in device memory, without copying the pairs to the host.
#include "collide/set_hash.h"

/// Writes the hash of each work-item's share of the pairs: `run` neighbours, or with a run of 0 those that are as far apart as
/// there are work-items.
kernel void hash_pairs(global const uint2* restrict pairs, const uint count, const uint run,
                       global ulong2* restrict hashes)
{
    const ulong item = get_global_id(0);
    const ulong end = run == 0u ? count : min((ulong)count, (item + 1ul) * run);
    const ulong step = run == 0u ? get_global_size(0) : 1ul;
    SetHash set = {0ul, 0ul};
    for (ulong k = run == 0u ? item : item * run; k < end; k += step)
        set = with_pair(set, pairs[k].x, pairs[k].y);
    hashes[item] = (ulong2)(set.low, set.high);
}

/// Lists the pairs with a triangle whose bit in `sample` is set, up to `room` of them, and counts all.
kernel void pairs_of_sample(global const uint2* restrict pairs, const uint count,
                            global const uint* restrict sample, global uint2* restrict found,
                            const uint room, volatile global uint* found_count)
{
    for (ulong k = get_global_id(0); k < count; k += get_global_size(0)) {
        const uint2 pair = pairs[k];
        const uint bits =
            sample[pair.x / 32u] >> pair.x % 32u | sample[pair.y / 32u] >> pair.y % 32u;
        if ((bits & 1u) == 0u)
            continue;
        const uint place = atomic_inc(found_count);
        if (place < room)
            found[place] = pair;
    }
}
