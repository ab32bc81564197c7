// SPDX-License-Identifier: MIT
// check: -DNAMED=0
// check: -DNAMED=1
//
// What identifies a set of pairs in device memory, without copying the pairs to the host. NAMED: pairs are known by the names of
// their triangles, which names[] has.
#include "collide/set_hash.h"

#if NAMED
#define NAMES_PARAMETER , global const uint* restrict names
#define NAME(triangle) names[triangle]
#else
#define NAMES_PARAMETER
#define NAME(triangle) (triangle)
#endif

/// Writes the hash of each work-item's share of the pairs: `run` neighbours, or with a run of 0 those that are as far apart as
/// there are work-items.
kernel void hash_pairs(global const uint2* restrict pairs, const uint count, const uint run,
                       global ulong2* restrict hashes NAMES_PARAMETER)
{
    const ulong item = get_global_id(0);
    const ulong end = run == 0u ? count : min((ulong)count, (item + 1ul) * run);
    const ulong step = run == 0u ? get_global_size(0) : 1ul;
    SetHash set = {0ul, 0ul};
    for (ulong k = run == 0u ? item : item * run; k < end; k += step)
        set = with_pair(set, NAME(pairs[k].x), NAME(pairs[k].y));
    hashes[item] = (ulong2)(set.low, set.high);
}

/// Lists the pairs with a triangle whose bit in `sample` is set, up to `room` of them, and counts all.
kernel void pairs_of_sample(global const uint2* restrict pairs, const uint count,
                            global const uint* restrict sample, global uint2* restrict found,
                            const uint room, volatile global uint* found_count NAMES_PARAMETER)
{
    for (ulong k = get_global_id(0); k < count; k += get_global_size(0)) {
        const uint2 pair = (uint2)(NAME(pairs[k].x), NAME(pairs[k].y));
        const uint bits =
            sample[pair.x / 32u] >> pair.x % 32u | sample[pair.y / 32u] >> pair.y % 32u;
        if ((bits & 1u) == 0u)
            continue;
        const uint place = atomic_inc(found_count);
        if (place < room)
            found[place] = pair;
    }
}
