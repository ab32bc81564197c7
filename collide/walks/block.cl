// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DTEAMS=1u -DLOOSE=4u -DTEAMS_A_TASK=2u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DTEAMS=4u -DLOOSE=4u -DTEAMS_A_TASK=1u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DTEAMS=4u -DLOOSE=4u -DTEAMS_A_TASK=1u -DBOX_FORMAT=1u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DTEAMS=4u -DLOOSE=4u -DTEAMS_A_TASK=1u -DBOX_FORMAT=2u
//
// A team queries the tree with a block of 32 neighbouring leaves, which form a subtree. It traverses the implicit binary tree as
// a tree of nodes with 32 children: each step skips five levels, Eq. (12), since a node's descendants there are contiguous in
// memory. Each lane tests one descendant against the block's box. Leaves that overlap it are collected; once there are 32, each
// lane tests its own leaf of the block against all of them.
//
//     level          L - 10     L - 5      L           of the binary tree; L is the level of the leaves
//     wide level     2          1          0
//                    o          oooo...    oooo...     a step takes the 32 descendants of one node, one per lane
//
// In its own tree, a block is tested only against what follows it: of its ancestors, only the descendants after the block's own
// path. So each pair of blocks is met once. Where the order of leaves jumps, a block's box spans distant places: if its area is
// more than LOOSE times the summed area of its leaves, a node must also overlap one of the leaves.
//
// The traversal is depth-first, last node first. A node taken from the stack leaves at most 32 nodes, one wide level nearer to
// the leaves. So a stack with 31 entries per wide level below the root's, plus the block's ancestors, never overflows.
//
// TEAMS_A_TASK teams share a task: of the nodes above the leaves each takes those whose label is its number modulo TEAMS_A_TASK, and
// only the first tests the block's leaves against each other. All take the steps above. So long walks end sooner where there are few.
//
// `pairs`, `counters` and the tasks are as in group_groups.cl. Teams of a group synchronise only to add up their box tests.
#include "collide/walks/block_team.clh"
#include "collide/walks/task.clh"

#if LANES != 1u && LANES != TEAM_LANES
#error "the host launches TEAM_LANES work-items a team"
#endif

// A stack entry: a node's label, which has 26 bits above a tree's last five levels, and the wide level of its descendants.
#define ENTRY(node, wide) ((node) << 3u | (wide))
#define NODE_OF(entry) ((entry) >> 3u)
#define WIDE_OF(entry) ((entry)&7u)

/// Returns the box of a leaf, given tree_row of the leaves' level.
static inline Aabb leaf_box_at(TREE_PARAMETERS, const uint row, const uint leaf)
{
#if SORTED_LEAVES
    return tree_row_box(TREE, row, leaf);
#else
    (void)row;
    return load_box(leaf_boxes, tree_triangle(TREE, leaf));
#endif
}

/// Loads the leaves of a task into `team` and their common box into `common`. True if that is loose (LOOSE).
static inline bool load_block(FOREST_PARAMETERS, local Team *team, const uint lane,
                              global const Face *faces, const QueryTask task, Aabb *common)
{
    PICK_TREE(task.own)
    const uint leaf_level = ceil_log2(leaves), up = min(leaf_level, BLOCK_LEVELS);
    const uint row = tree_row(TREE, leaf_level), first = tree_leaf(TREE, task.first);
    *common = tree_box(TREE, first >> up);
    float area = 0.0f;
    EACH (k) {
        const uint leaf = first + min(k, task.count - 1u);
        const Aabb box = leaf_box_at(TREE, row, leaf);
        put_box(team->own_low, team->own_high, k, box);
        team->own_ids[k] = tree_triangle(TREE, leaf);
        area += half_surface(box);
    }
    load_faces(team->own_faces, team->own_ids, lane, faces, BLOCK);
    return half_surface(*common) > LOOSE * team_sum(area);
}

/// Initialises the stack: with the root, and in the block's own tree with its ancestors on wide levels, the nearest last; and the
/// table of wide levels. In its own tree a block is tested only against labels after its own path: of the ancestors' descendants
/// these are all that are new, and whatever is below these comes later too. `own_leaf` is the label of the block's first leaf, 0 in
/// another object's tree. Returns the number of entries.
static inline uint open_walk(TREE_PARAMETERS, local Team *team, const uint lane,
                             const uint own_leaf)
{
    const uint leaf_level = ceil_log2(leaves);
    const uint wide_levels = divided_up(leaf_level, BLOCK_LEVELS);
    const uint depth = own_leaf == 0u ? 1u : max(wide_levels, 1u) - 1u;
    for (uint k = lane; k < depth; k += LANES) {
        // The root's descendants are the level with at most 32 nodes: label 1 if it has exactly 32, label 0 if fewer.
        const uint node = k > 0u ? own_leaf >> (BLOCK_LEVELS * (wide_levels - k))
                          : leaf_level > 0u && leaf_level % BLOCK_LEVELS == 0u ? 1u
                                                                               : 0u;
        team->stack[k] = ENTRY(node, max(wide_levels - k, 1u) - 1u);
    }
    for (uint k = lane; k < max(wide_levels, 1u); k += LANES) {
        const uint level = leaf_level - BLOCK_LEVELS * k;
        const uint begin = own_leaf == 0u ? 1u << level : (own_leaf >> (BLOCK_LEVELS * k)) + 1u;
        team->levels[k] = (uint4)(tree_row(TREE, level), begin, tree_row_end(TREE, level) - 1u, 0u);
    }
    team_fence();
    return depth;
}

/// Finds the pairs of a task's leaves that fall to the team of number `share` (TEAMS_A_TASK). Returns the number of box tests, which exceeds 32 bits if the block's box overlaps some 10^8
/// leaves.
static inline ulong walk_block(FOREST_PARAMETERS, local Team *team, SINK_PARAMETERS,
                               global const Face *faces, const QueryTask task, const uint share)
{
    Aabb common;
    const bool is_own = task.own == task.other;
    const bool is_loose = load_block(FOREST, team, lane, faces, task, &common);
    PICK_TREE(task.other)
    uint tests = 0u, met = 0u, kept_count = 0u, seen = 0u;
    if (is_own && share == 0u) {
        kept_count = meet_within(team, SINK, kept_count, task.count);
        tests = task.count * (task.count - 1u) / 2u;
    }
    uint waiting = open_walk(TREE, team, lane, is_own ? tree_leaf(TREE, task.first) : 0u);
    if (share > 0u && leaves <= BLOCK)  // no nodes above the leaves to share
        waiting = 0u;
    while (waiting > 0u) {
        --waiting;
        const uint entry = team->stack[waiting], first = NODE_OF(entry) << BLOCK_LEVELS;
        const uint wide = WIDE_OF(entry);
        const uint4 level = team->levels[wide];  // row, first and last label
        tests += min(level.z + 1u, first + BLOCK) - max(level.y, first);
        EACH (k) {
            const uint label = first + k, node = min(max(label, level.y), level.z);
            const Aabb box = SORTED_LEAVES || wide > 0u ? tree_row_box(TREE, level.x, node)
                                                        : leaf_box_at(TREE, level.x, node);
            const uint triangle = wide > 0u ? 0u : tree_triangle(TREE, node);
            bool meets = label >= level.y && label == node && overlap(common, box) &&
                         (wide != 1u || label % TEAMS_A_TASK == share);
            if (is_loose && meets)
                meets = meets_any(team, box);
            const uint votes = team_vote(meets);  // by now all lanes have read the entry
            if (wide > 0u) {
                if (meets)
                    team->stack[waiting + lanes_before(votes)] = ENTRY(label, wide - 1u);
                waiting += popcount(votes);
            } else {
                const uint place = seen + lanes_before(votes);
                if (meets) {
                    put_box(team->seen_low, team->seen_high, place, box);
                    team->seen_ids[place] = triangle;
                }
                seen += popcount(votes);
            }
        }
        team_fence();
        while (seen >= BLOCK || (waiting == 0u && seen > 0u)) {
            const uint many = min(seen, BLOCK);
            seen -= many;
            met += many;
            kept_count = meet_seen(team, SINK, faces, kept_count, task.count, seen, many);
        }
    }
    close_sink(SINK, kept_count);
    return tests + (ulong)met * task.count;
}

/// TEAMS_A_TASK teams per task. `counters` are zero but for what between.cl added; `next_counters`, of the next query, are zero afterwards.
/// `pairs` receives what fits; everything is counted.
__attribute__((reqd_work_group_size(TEAMS * LANES, 1, 1))) kernel void block_pairs(
    FOREST_PARAMETERS, global const uint *ropes, global const Face *faces, global uint2 *pairs,
    const uint capacity, volatile global uint *counters, TASKS_PARAMETERS,
    global uint *next_counters, const uint counter_count)
{
    local Team teams[TEAMS];
    local ulong tests[TEAMS];
    (void)ropes;
    zero_next(next_counters, counter_count);
    const uint lane = (uint)get_local_id(0) % LANES, own = (uint)get_local_id(0) / LANES;
    local Team *team = teams + own;
    local uint2 *kept = team->kept;
    const uint index = (uint)get_group_id(0) * TEAMS + own;
    const QueryTask task = task_of(TASKS, counters, index / TEAMS_A_TASK);
    ulong tested = 0ul;
    if (task.count > 0u)
        tested = walk_block(FOREST, team, SINK, faces, task, index % TEAMS_A_TASK);
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
