// SPDX-License-Identifier: MIT
// check:

/// numbers[k] is k, for all `count`.
kernel void number_all(global uint* restrict numbers, const uint count)
{
    const uint k = (uint)get_global_id(0);
    if (k < count)
        numbers[k] = k;
}

/// Ids of the leaves of some objects go back among those of all objects. `sorted` holds them one object behind the other,
/// and counts both places and ids among these objects only: before run.first, run.standing triangles (ObjectRun) belong to
/// other objects. A run is a work-group's or a work-item's.
kernel void put_runs(global const uint* restrict sorted, global const uint4* restrict runs,
                     global uint* restrict ids)
{
    const uint4 run = runs[get_group_id(0)];
    for (uint k = run.x + (uint)get_local_id(0); k < run.y; k += (uint)get_local_size(0))
        ids[k] = sorted[k - run.w] + run.w;
}
