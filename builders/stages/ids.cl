// SPDX-License-Identifier: MIT
// check:

/// Writes k to numbers[k], for all k below `count`.
kernel void number_all(global uint* restrict numbers, const uint count)
{
    const uint k = (uint)get_global_id(0);
    if (k < count)
        numbers[k] = k;
}

/// Copies the ids of reordered objects back among those of all objects, one run per work-group or work-item. `sorted` has only
/// the reordered objects, one after the other, and counts both places and ids among their triangles; run.standing (ObjectRun)
/// triangles of other objects precede a run.
kernel void put_runs(global const uint* restrict sorted, global const uint4* restrict runs,
                     global uint* restrict ids)
{
    const uint4 run = runs[get_group_id(0)];
    for (uint k = run.x + (uint)get_local_id(0); k < run.y; k += (uint)get_local_size(0))
        ids[k] = sorted[k - run.w] + run.w;
}
