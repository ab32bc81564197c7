// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=256u -DVALUES_PER_ITEM=4u
//
// Each value becomes the sum of all before it. Three launches: every group or chunk leaves the sum of its values in
// `partials`, one group or work-item scans those, and every group or chunk goes on from its own.
#include "builders/stages/chunk.clh"
#include "builders/stages/group_scan.clh"

#define TILE (GROUP_SIZE * VALUES_PER_ITEM)

/// Values of this work-item, zero past all. One by one: `values` need not end with a whole tile.
static inline uint4 own_values(global const uint* values, const uint first, const uint count)
{
    return (uint4)(first < count ? values[first] : 0u, first + 1u < count ? values[first + 1u] : 0u,
                   first + 2u < count ? values[first + 2u] : 0u,
                   first + 3u < count ? values[first + 3u] : 0u);
}

/// partials[g] is the sum of group g's tile.
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

/// One group, each work-item a run of partials: no loop goes round a barrier.
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

/// As sum_groups, each work-item by itself.
kernel void sum_chunks(global const uint* restrict values, global uint* restrict partials,
                       const uint count)
{
    const Chunk chunk = own_chunk(count);
    uint sum = 0u;
    for (uint k = chunk.first; k < chunk.end; ++k)
        sum += values[k];
    partials[get_global_id(0)] = sum;
}

/// One work-item.
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
