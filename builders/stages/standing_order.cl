// SPDX-License-Identifier: MIT
// check: -DCODE_WORDS=1u
// check: -DCODE_WORDS=2u
//
// The order in which the frame before left its leaves, tried on the codes of this one.
//
// `standing` holds the ids of objects that are lined up anew, one object behind the other, and both places and ids are
// counted among those only: run.w (ObjectRun) triangles lie before them that are not. A run is a group's or a
// work-item's, whichever launches.
#include "builders/stages/chunk.clh"
#include "builders/stages/code.clh"
#include "builders/stages/idle.clh"

/// standing[place] becomes the id that `ids`, those of all objects, have there.
kernel void take_order(global const uint* restrict ids, global const uint4* restrict runs,
                       global uint* restrict standing)
{
    const uint4 run = runs[get_group_id(0)];
    for (uint k = run.x + (uint)get_local_id(0); k < run.y; k += (uint)get_local_size(0))
        standing[k - run.w] = ids[k] - run.w;
}

/// The reverse, of ids that were sorted, unless they are in order as they are.
kernel void put_order(global const uint* restrict sorted, global const uint4* restrict runs,
                      global uint* restrict ids, global const uint* restrict unsorted,
                      const uint build)
{
    if (is_idle(unsorted, build))
        return;
    const uint4 run = runs[get_group_id(0)];
    for (uint k = run.x + (uint)get_local_id(0); k < run.y; k += (uint)get_local_size(0))
        ids[k] = sorted[k - run.w] + run.w;
}

/// Whether a stable sort would leave two neighbours the other way round.
static inline bool is_broken(global const Code* codes, const uint id, const uint next)
{
    const Code code = codes[id], next_code = codes[next];
    return code > next_code || (code == next_code && id > next);
}

/// *unsorted becomes `build` if two neighbours of the standing order are the wrong way round. Once that is known, the
/// rest is not looked at.
kernel void try_order_groups(global const Code* restrict codes,
                             global const uint* restrict standing, volatile global uint* unsorted,
                             const uint count, const uint build)
{
    const uint k = (uint)get_global_id(0);
    if (k + 1u < count && *unsorted != build && is_broken(codes, standing[k], standing[k + 1u]))
        atomic_xchg(unsorted, build);
}

/// The same, each work-item a stretch.
kernel void try_order_chunks(global const Code* restrict codes,
                             global const uint* restrict standing, volatile global uint* unsorted,
                             const uint count, const uint build)
{
    const Chunk chunk = own_chunk(count - 1u);
    for (uint k = chunk.first; k < chunk.end; ++k)
        if (is_broken(codes, standing[k], standing[k + 1u])) {
            atomic_xchg(unsorted, build);
            return;
        }
}

/// ordered[k] becomes the code of leaf k, if leaves are in order as they are.
kernel void order_codes(global const Code* restrict codes, global const uint* restrict standing,
                        global Code* restrict ordered, global const uint* restrict unsorted,
                        const uint count, const uint build)
{
    const uint k = (uint)get_global_id(0);
    if (k < count && is_idle(unsorted, build))
        ordered[k] = codes[standing[k]];
}

/// Back to where a sort would have left them.
kernel void copy_codes(global const Code* restrict ordered, global Code* restrict codes,
                       global const uint* restrict unsorted, const uint count, const uint build)
{
    const uint k = (uint)get_global_id(0);
    if (k < count && is_idle(unsorted, build))
        codes[k] = ordered[k];
}
