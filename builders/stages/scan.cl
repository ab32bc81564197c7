// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=256u -DVALUES_PER_ITEM=4u
//
// Exclusive prefix sums in three launches: every group or chunk writes the sum of its values to `partials`, one group or
// work-item scans the partials, and every group or chunk scans its values from its own partial on.
#include "builders/stages/chunk.clh"
#include "builders/stages/group_scan.clh"

#define TILE (GROUP_SIZE * VALUES_PER_ITEM)

/// Returns this work-item's values; 0 past the end. Loads are scalar, because `values` may end within a tile.
static inline uint4 own_values(global const uint* values, const uint first, const uint count)
{
    return (uint4)(first < count ? values[first] : 0u, first + 1u < count ? values[first + 1u] : 0u,
                   first + 2u < count ? values[first + 2u] : 0u,
                   first + 3u < count ? values[first + 3u] : 0u);
}

/// Writes the sum of group g's tile to partials[g].
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void sum_groups(
    global const uint* restrict values, global uint* restrict partials, const uint count)
{
    local uint scratch[SCAN_SCRATCH];
    const uint first = (uint)get_global_id(0) * VALUES_PER_ITEM;
    const uint4 own = own_values(values, first, count);
    uint all;
    sum_before(own.x + own.y + own.z + own.w, scratch, &all);
    if (get_local_id(0) == 0)
        partials[get_group_id(0)] = all;
}

/// Scans the partials in one group, a run per work-item, so that no barrier is in a loop.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void scan_partials_group(
    global uint* restrict partials, const uint partial_count)
{
    local uint scratch[SCAN_SCRATCH];
    const Chunk chunk = own_chunk(partial_count);
    uint sum = 0u;
    for (uint k = chunk.first; k < chunk.end; ++k)
        sum += partials[k];
    uint all;
    uint before = sum_before(sum, scratch, &all);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const uint own = partials[k];
        partials[k] = before;
        before += own;
    }
}

__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void scan_groups(
    global uint* restrict values, global const uint* restrict partials, const uint count)
{
    local uint scratch[SCAN_SCRATCH];
    const uint first = (uint)get_global_id(0) * VALUES_PER_ITEM;
    const uint4 own = own_values(values, first, count);
    uint all;
    const uint before =
        partials[get_group_id(0)] + sum_before(own.x + own.y + own.z + own.w, scratch, &all);
    if (first < count)
        values[first] = before;
    if (first + 1u < count)
        values[first + 1u] = before + own.x;
    if (first + 2u < count)
        values[first + 2u] = before + own.x + own.y;
    if (first + 3u < count)
        values[first + 3u] = before + own.x + own.y + own.z;
}

/// As sum_groups, a chunk per work-item.
kernel void sum_chunks(global const uint* restrict values, global uint* restrict partials,
                       const uint count)
{
    const Chunk chunk = own_chunk(count);
    uint sum = 0u;
    for (uint k = chunk.first; k < chunk.end; ++k)
        sum += values[k];
    partials[get_global_id(0)] = sum;
}

/// As scan_partials_group, in one work-item.
kernel void scan_partials_chunk(global uint* restrict partials, const uint partial_count)
{
    uint before = 0u;
    for (uint k = 0u; k < partial_count; ++k) {
        const uint own = partials[k];
        partials[k] = before;
        before += own;
    }
}

kernel void scan_chunks(global uint* restrict values, global const uint* restrict partials,
                        const uint count)
{
    const Chunk chunk = own_chunk(count);
    uint before = partials[get_global_id(0)];
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const uint own = values[k];
        values[k] = before;
        before += own;
    }
}
