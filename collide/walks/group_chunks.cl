// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DTASK_LEAVES=64u -DSKIP_OVERLAP=1
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=0 -DTASK_LEAVES=64u -DSKIP_OVERLAP=1
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=0 -DTASK_LEAVES=64u -DSKIP_OVERLAP=1 -DBOX_FORMAT=1u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=0 -DTASK_LEAVES=64u -DSKIP_OVERLAP=1 -DBOX_FORMAT=3u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=0 -DTASK_LEAVES=64u -DSKIP_OVERLAP=1 -DBOX_FORMAT=4u
// check: -include oibvh/wide/wide8_access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=1 -DTASK_LEAVES=64u -DSKIP_OVERLAP=0
// check: -include oibvh/wide/wide4_access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=1 -DTASK_LEAVES=64u -DSKIP_OVERLAP=0
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DTASK_LEAVES=64u -DSKIP_OVERLAP=1
// check: -include baselines/hploc/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DTASK_LEAVES=64u -DSKIP_OVERLAP=1
//
// Queries a tree with all leaves of a task at once, for few cores with wide registers. The common box of the leaves traverses the
// tree, and the leaves that it overlaps are collected in a line. Then each block of LANES leaves of the task selects the steps of
// the line that overlap the common box of the block, and tests each of its leaves against LANES boxes of a step at once.
//
//     task's leaves    | block | block | ...            line    | step | step | step | ...
//     block x line     the steps that overlap the block's box
//     leaf x step      a hit: the lanes that overlap the leaf; without those that share a corner with it; then pairs
//
// Each of these is a loop without a data-dependent branch: entries are always written, and counted only if wanted.
#include "collide/found.clh"
#include "collide/walks/line_walk.clh"
#include "geometry/bits.h"

/// A hit of leaf `leaf` of the task, at most 256, in a step: low bits the lanes, then the step, then the leaf.
static inline uint hit_of(const uint leaf, const uint step, const uint lanes)
{
    return leaf << (LANES + 8u) | step << LANES | lanes;
}
static inline uint lanes_of(const uint hit) { return hit & ALL_LANES; }
static inline uint step_of(const uint hit) { return hit >> LANES & 0xffu; }
static inline uint leaf_of(const uint hit) { return hit >> (LANES + 8u); }

/// Writes to `steps` the steps of `line`, from `first` on, that overlap a block's box; returns their number.
static inline uint near_steps(const Aabb block, const Line* line, const uint first,
                              const uint count, uchar* steps)
{
    uint found = 0u;
    for (uint step = first; step * LANES < count; ++step) {
        steps[found] = (uchar)step;
        found += lanes_that_meet(line, step, block) != 0u ? 1u : 0u;
    }
    return found;
}

/// Writes the hits of a block's leaves in these steps; on the task's own line, only with later leaves. Returns their number.
static inline uint hits_of(const Line* own, const uint begin, const uint end, const Line* line,
                           const uchar* steps, const uint step_count, uint* hits)
{
    uint found = 0u;
    for (uint k = begin; k < end; ++k) {
        const Aabb box = box_at(own, k);
        for (uint s = 0u; s < step_count; ++s) {
            const uint step = steps[s];
            uint lanes = lanes_that_meet(line, step, box);
            if (own == line && step == k / LANES)
                lanes &= (ALL_LANES - 1u) << k % LANES;
            hits[found] = hit_of(k, step, lanes);
            found += lanes != 0u ? 1u : 0u;
        }
    }
    return found;
}

/// Removes, in place, lanes that share a corner and hits that are then empty. Returns the number of hits.
static inline uint without_adjacent(const Line* own, const Line* line, uint* hits, const uint count)
{
    uint found = 0u;
    for (uint h = 0u; h < count; ++h) {
        const uint hit = hits[h];
        const uint kept = hit & ~lanes_that_share(line, step_of(hit), own, leaf_of(hit));
        hits[found] = kept;
        found += lanes_of(kept) != 0u ? 1u : 0u;
    }
    return found;
}

/// Writes one pair per lane, up to `count`, in a single loop over the lanes of all hits. The hit after the last must be empty.
static inline void put_hits(const Line* own, const Line* line, const uint* hits,
                            global uint2* pairs, const uint count)
{
    uint h = 0u, lanes = lanes_of(hits[0]);
    for (uint k = 0u; k < count; ++k) {
        const uint hit = hits[h], next = lanes_of(hits[h + 1u]);
        const uint other = step_of(hit) * LANES + lowest_lane(lanes);
        pairs[k] = pair_of(own->triangle[leaf_of(hit)], line->triangle[other]);
        lanes &= lanes - 1u;
        h += lanes == 0u ? 1u : 0u;
        lanes = lanes == 0u ? next : lanes;
    }
}

/// Finds the pairs of the task's `own_count` leaves, whose blocks have the boxes `blocks`, and a line, possibly the same line. Returns
/// the number of box tests.
static inline uint hold_against(Line* own, const uint own_count, const Aabb* blocks, Line* line,
                                const uint count, global const Face* faces, global uint2* pairs,
                                const uint capacity, volatile global uint* counters)
{
    uchar steps[LINE_STEPS];
    uint hits[TASK_LEAVES * LINE_STEPS + 1u];
    uint tests = 0u, found = 0u;
    for (uint begin = 0u; begin < own_count; begin += LANES) {
        const uint end = min(own_count, begin + LANES), first = own == line ? begin / LANES : 0u;
        const uint near = near_steps(blocks[begin / LANES], line, first, count, steps);
        found += hits_of(own, begin, end, line, steps, near, hits + found);
        tests += divided_up(count, LANES) - first + near * (end - begin);
    }
    if (!KEEP_ADJACENT && found != 0u) {
        set_corners(own, own_count, faces);
        set_corners(line, count, faces);
        found = without_adjacent(own, line, hits, found);
    }
    hits[found] = 0u;
    uint pair_count = 0u;
    for (uint h = 0u; h < found; ++h)
        pair_count += (uint)popcount(lanes_of(hits[h]));
    if (pair_count != 0u) {
        const uint slot = add_wide(counters + PAIRS_COUNT, pair_count);
        const uint room = capacity - min(capacity, slot);
        put_hits(own, line, hits, pairs + slot, min(pair_count, room));
    }
    return LANES * tests;
}

/// Grows `whole` by a box: an instruction a side, where fmin and fmax take several, as they allow NaN.
static inline void grow(Aabb* whole, const Aabb box)
{
    whole->min_x = box.min_x < whole->min_x ? box.min_x : whole->min_x;
    whole->min_y = box.min_y < whole->min_y ? box.min_y : whole->min_y;
    whole->min_z = box.min_z < whole->min_z ? box.min_z : whole->min_z;
    whole->max_x = box.max_x > whole->max_x ? box.max_x : whole->max_x;
    whole->max_y = box.max_y > whole->max_y ? box.max_y : whole->max_y;
    whole->max_z = box.max_z > whole->max_z ? box.max_z : whole->max_z;
}

/// Loads the task's leaves, with `some` only those that overlap `whole`, the boxes of their blocks and their common box. Returns their
/// number.
static inline uint line_up(FOREST_PARAMETERS, const QueryTask task, const bool some,
                           const Aabb whole, Line* own, Aabb* blocks, Aabb* common)
{
    uint count = 0u;
    *common = empty_box();
    for (uint place = task.first; place < task.first + task.count; ++place) {
        const Aabb box = leaf_box_of(FOREST, task.own, place);
        if (some && !overlap(box, whole))
            continue;
        own->triangle[count] = leaf_triangle_of(FOREST, task.own, place);
        if (count % LANES == 0u)
            blocks[count / LANES] = empty_box();
        grow(&blocks[count / LANES], box);
        grow(common, box);
        set_box(own, count++, box);
    }
    close_line(own, count);
    return count;
}

/// As leaf_pairs in leaf_chunks.cl, but work-items take tasks from a counter.
kernel void group_pairs(FOREST_PARAMETERS, global const uint* ropes, global const Face* faces,
                        global uint2* pairs, const uint capacity, volatile global uint* counters,
                        TASKS_PARAMETERS)
{
    const uint count = task_count(TASKS, counters);
    ulong tests = 0ul;
    Line own, line;
    Aabb blocks[TASK_LEAVES / LANES + 1u];
    Walk walk;
    for (uint k = atomic_inc(counters + TASKS_BEGUN); k < count;
         k = atomic_inc(counters + TASKS_BEGUN)) {
        const QueryTask task = task_of(TASKS, counters, k);
        PICK_TREE(task.other)
        const bool is_own = task.own == task.other;
        const bool some = SKIP_OVERLAP && !is_own;
        const Aabb whole = tree_box(TREE, tree_root(TREE));
        Aabb common;
        const uint near = line_up(FOREST, task, some, whole, &own, blocks, &common);
        tests += some ? task.count : 0u;
        if (is_own)
            tests += hold_against(&own, near, blocks, &own, near, faces, pairs, capacity, counters);
        begin_walk(TREE, ropes, task, common, &walk);
        while (near != 0u && has_more(&walk)) {
            const uint met = fill_line(TREE, ropes, &walk, &line, &tests);
            tests += hold_against(&own, near, blocks, &line, met, faces, pairs, capacity, counters);
        }
    }
    add_wide(counters + BOX_TESTS_COUNT, tests);
}
