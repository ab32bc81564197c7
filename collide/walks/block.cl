// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DTEAMS=1u -DLOOSE=4u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DTEAMS=4u -DLOOSE=4u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DTEAMS=4u -DLOOSE=4u -DBOX_FORMAT=1u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DTEAMS=4u -DLOOSE=4u -DBOX_FORMAT=2u
//
// A block of 32 neighbouring leaves, a subtree, as one query of a team, which takes an implicit tree for one of nodes
// with 32 children each: five levels are skipped, Eq. (12), and a node's descendants there are neighbours in memory. A
// lane tests one of them against the block's box. Leaves that are met are collected, and when there are 32, each lane
// holds its own against all of them.
//
//     level          L - 10     L - 5      L           of the binary tree; the leaves' is L
//     wide level     2          1          0
//                    o          oooo...    oooo...     a step takes one node's 32 descendants, a lane each
//
// A block's own tree is walked behind it alone: of its ancestors, descendants that lie behind its own line; so each
// pair of blocks is met once. Where the order of leaves jumps, a block's box is that of places far apart: if it is LOOSE
// times as large, by area, as its leaves' are together, a node must meet one of them as well.
//
// The walk goes depth-first, the last node first. Of a node taken at most 32 come back, one level nearer to the leaves:
// so a stack of 31 for each wide level below the root's, and a block's ancestors, is never full.
//
// `pairs`, `counters` and the tasks are group_groups.cl's. Teams do not meet before they add up what they tested.
#include "collide/sinks/sink_teams.clh"
#include "collide/walks/task.clh"

#if LANES != 1u && LANES != TEAM_LANES
#error "the host launches TEAM_LANES work-items a team"
#endif

#define BLOCK BLOCK_LEAVES
#define WIDE_LEVELS 7u                    // of a tree of 2^31 leaves
#define STACK (32u * (WIDE_LEVELS - 1u))  // 31 a wide level and one more, and five ancestors
#define SEEN (2u * BLOCK)

// A node on the stack: its wide level, and its label, which has 26 bits below a tree's last five levels.
#define ENTRY(wide, node) ((wide) << 27u | (node))
#define WIDE_OF(entry) ((entry) >> 27u)
#define NODE_OF(entry) ((entry)&0x7ffffffu)

/// Leaves of a block or children of a node by a team's lanes, each its own.
#define EACH(k) for (uint k = lane; k < BLOCK; k += LANES)

/// What a team knows together.
typedef struct {
    uint2 kept[KEPT];  ///< first, so that one too many would be seen in what stands behind
    BoxWord own[WORDS_PER_BOX * BLOCK];  ///< boxes of the block's leaves, the last repeated
    BoxWord seen[WORDS_PER_BOX * SEEN];  ///< and of leaves that were met
    uint own_ids[BLOCK];                 ///< triangles
    uint seen_ids[SEEN];                 ///< labels of leaves, then triangles
    uint stack[STACK];
    uint rows[WIDE_LEVELS], ends[WIDE_LEVELS];  ///< of the other tree's wide levels
} Team;

/// Each of a block's leaves against those behind it around the circle, half way. How many pairs are kept.
static inline uint meet_within(local Team *team, SINK_PARAMETERS, uint kept_count, const uint count)
{
    EACH (k) {
        const Aabb box = load_local_box(team->own, k);
        uint behind = 0u;  // bit s: it meets the one s + 1 behind it
#pragma unroll
        for (uint step = 0u; step < BLOCK / 2u; ++step)
            if (overlap(box, load_local_box(team->own, (k + step + 1u) % BLOCK)))
                behind |= 1u << step;
        if (k >= BLOCK / 2u)  // the one opposite counts it
            behind &= ~(1u << (BLOCK / 2u - 1u));
        const uint hits = rotate(behind, k + 1u) & (0xffffffffu >> (BLOCK - count));
        kept_count =
            put_hits(SINK, kept_count, team->own_ids[k], team->own_ids, k < count ? hits : 0u);
    }
    return kept_count;
}

/// The block's `own_count` leaves against `count` seen ones from `first` on, 1 to 32. How many pairs are kept.
static inline uint meet_seen(local Team *team, SINK_PARAMETERS, TREE_PARAMETERS, uint kept_count,
                             const uint own_count, const uint first, const uint count)
{
    EACH (k)
        if (k < count)
            team->seen_ids[first + k] = tree_triangle(TREE, team->seen_ids[first + k]);
    team_fence();
    EACH (k) {
        const Aabb box = load_local_box(team->own, k);
        uint hits = 0u;
        for (uint others = 0u; others < count; others += 4u) {
#pragma unroll
            for (uint other = others; other < others + 4u; ++other)
                if (overlap(box, load_local_box(team->seen, first + other)))
                    hits |= 1u << other;
        }
        hits &= 0xffffffffu >> (BLOCK - count);
        kept_count = put_hits(SINK, kept_count, team->own_ids[k], team->seen_ids + first,
                              k < own_count ? hits : 0u);
    }
    team_fence();
    return kept_count;
}

/// Whether one of a block's boxes overlaps `box`.
static inline bool meets_any(local const BoxWord *boxes, const Aabb box)
{
    bool meets = false;
#pragma unroll 8
    for (uint k = 0u; k < BLOCK; ++k)
        meets |= overlap(load_local_box(boxes, k), box);
    return meets;
}

/// The leaves of a task into `team`. Whether their common box says too little of them.
static inline bool load_block(FOREST_PARAMETERS, local Team *team, const uint lane,
                              const QueryTask task, const Aabb common)
{
    float area = 0.0f;
    EACH (k) {
        const uint place = task.first + min(k, task.count - 1u);
        const Aabb box = leaf_box_of(FOREST, task.own, place);
        store_local_box(team->own, k, box);
        team->own_ids[k] = leaf_triangle_of(FOREST, task.own, place);
        area += half_surface(box);
    }
    team_fence();
    return half_surface(common) > LOOSE * team_sum(area);
}

/// Where a walk begins: the root, and of the block's own tree its ancestors on wide levels, the nearest last, for the
/// leaf with the label `own_leaf`; 0 in another object's tree. How many they are.
static inline uint open_walk(TREE_PARAMETERS, local Team *team, const uint lane,
                             const uint own_leaf)
{
    const uint leaf_level = ceil_log2(leaves);
    const uint wide_levels = divided_up(leaf_level, BLOCK_LEVELS);
    const uint depth = own_leaf == 0u ? 1u : max(wide_levels, 1u) - 1u;
    for (uint k = lane; k < depth; k += LANES) {
        // The root's descendants are the nodes of a level that has 32 at most: of label 1 the 32, of 0 fewer.
        const uint node = k > 0u ? own_leaf >> (BLOCK_LEVELS * (wide_levels - k))
                          : leaf_level > 0u && leaf_level % BLOCK_LEVELS == 0u ? 1u
                                                                               : 0u;
        team->stack[k] = ENTRY(wide_levels - k, node);
    }
    for (uint k = lane; k < max(wide_levels, 1u); k += LANES) {
        team->rows[k] = tree_row(TREE, leaf_level - BLOCK_LEVELS * k);
        team->ends[k] = tree_row_end(TREE, leaf_level - BLOCK_LEVELS * k);
    }
    team_fence();
    return depth;
}

/// The pairs of a task's leaves. How many boxes it tested.
static inline uint walk_block(FOREST_PARAMETERS, local Team *team, SINK_PARAMETERS,
                              const QueryTask task, const Aabb common)
{
    const bool is_own = task.own == task.other;
    const bool is_loose = load_block(FOREST, team, lane, task, common);
    PICK_TREE(task.other)
    const uint leaf_level = ceil_log2(leaves);
    const uint own_leaf = is_own ? tree_leaf(TREE, task.first) : 0u;
    uint tests = 0u, kept_count = 0u, seen = 0u;
    if (is_own) {
        kept_count = meet_within(team, SINK, kept_count, task.count);
        tests = task.count * (task.count - 1u) / 2u;
    }
    uint waiting = open_walk(TREE, team, lane, own_leaf);
    while (waiting > 0u) {
        --waiting;
        const uint entry = team->stack[waiting], node = NODE_OF(entry);
        const uint wide = max(WIDE_OF(entry), 1u) - 1u;  // of its descendants
        const uint row = team->rows[wide], end = team->ends[wide], first = node << BLOCK_LEVELS;
        const uint own_below = own_leaf >> (BLOCK_LEVELS * wide);
        const bool is_ancestor = is_own && own_below >> BLOCK_LEVELS == node;
        const uint begin = is_ancestor ? own_below + 1u : 1u << (leaf_level - BLOCK_LEVELS * wide);
        tests += min(end, first + BLOCK) - max(begin, first);
        team_fence();
        EACH (k) {
            const uint label = first + k;
            bool meets = label >= begin && label < end;
            Aabb box;
            if (meets) {
                box = SORTED_LEAVES || wide > 0u ? tree_row_box(TREE, row, label)
                                                 : tree_box(TREE, label);
                meets = overlap(common, box);
                if (meets && is_loose)
                    meets = meets_any(team->own, box);
            }
            const uint votes = team_vote(meets);
            const uint place = (wide > 0u ? waiting : seen) + lanes_before(votes);
            if (meets && wide > 0u)
                team->stack[place] = ENTRY(wide, label);
            if (meets && wide == 0u) {
                store_local_box(team->seen, place, box);
                team->seen_ids[place] = label;
            }
            waiting += wide > 0u ? popcount(votes) : 0u;
            seen += wide == 0u ? popcount(votes) : 0u;
        }
        team_fence();
        while (seen >= BLOCK || (waiting == 0u && seen > 0u)) {
            const uint many = min(seen, BLOCK);
            seen -= many;
            tests += many * task.count;
            kept_count = meet_seen(team, SINK, TREE, kept_count, task.count, seen, many);
        }
    }
    close_sink(SINK, kept_count);
    return tests;
}

static inline Aabb block_box(FOREST_PARAMETERS, const QueryTask task)
{
    PICK_TREE(task.own)
    return tree_box(TREE, tree_ancestor(TREE, tree_leaf(TREE, task.first), BLOCK_LEVELS));
}

/// `counters` are zero but for the tasks. Afterwards `pairs` begin with all of them, if there was room.
__attribute__((reqd_work_group_size(TEAMS * LANES, 1, 1))) kernel void block_pairs(
    FOREST_PARAMETERS, global const uint *ropes, global const Face *faces, global uint2 *pairs,
    const uint capacity, volatile global uint *counters, TASKS_PARAMETERS)
{
    local Team teams[TEAMS];
    local uint tests[TEAMS];
    (void)ropes;
    const uint lane = (uint)get_local_id(0) % LANES, own = (uint)get_local_id(0) / LANES;
    local Team *team = teams + own;
    local uint2 *kept = team->kept;
    const QueryTask task = task_of(TASKS, counters, (uint)get_group_id(0) * TEAMS + own);
    uint tested = 0u;
    if (task.count > 0u)
        tested = walk_block(FOREST, team, SINK, task, block_box(FOREST, task));
    if (lane == 0u)
        tests[own] = tested;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (get_local_id(0) == 0) {
        ulong sum = 0ul;
        for (uint k = 0u; k < TEAMS; ++k)
            sum += tests[k];
        add_wide(counters + BOX_TESTS_COUNT, sum);
    }
}
