// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DTEAMS=1u -DLOOSE=4u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DTEAMS=4u -DLOOSE=4u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DTEAMS=4u -DLOOSE=4u -DBOX_FORMAT=1u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DTEAMS=4u -DLOOSE=4u -DBOX_FORMAT=2u
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
// `pairs`, `counters` and the tasks are as in group_groups.cl. Teams of a group synchronise only to add up their box tests.
#include "collide/sinks/sink_teams.clh"
#include "collide/walks/task.clh"

#if LANES != 1u && LANES != TEAM_LANES
#error "the host launches TEAM_LANES work-items a team"
#endif

#define BLOCK BLOCK_LEAVES
#define WIDE_LEVELS 7u                    // enough for 2^31 leaves
#define STACK (32u * (WIDE_LEVELS - 1u))  // 31 per wide level and one more, and five ancestors
#define SEEN (2u * BLOCK)

// A stack entry: a node's wide level, and its label, which has 26 bits above a tree's last five levels.
#define ENTRY(wide, node) ((wide) << 27u | (node))
#define WIDE_OF(entry) ((entry) >> 27u)
#define NODE_OF(entry) ((entry)&0x7ffffffu)

/// Loops over the leaves of a block or the children of a node, split among the lanes of a team.
#define EACH(k) for (uint k = lane; k < BLOCK; k += LANES)

/// State of a team, in local memory.
typedef struct {
    uint2 kept[KEPT];                    ///< first: an overflow shows in the members behind
    BoxWord own[WORDS_PER_BOX * BLOCK];  ///< boxes of the block's leaves, the last one repeated
    BoxWord seen[WORDS_PER_BOX * SEEN];  ///< boxes of leaves to be tested
    uint own_ids[BLOCK];                 ///< triangles of the block
    uint seen_ids[SEEN];                 ///< labels of those leaves, later their triangles
    uint stack[STACK];
    uint rows[WIDE_LEVELS], ends[WIDE_LEVELS];  ///< rows and ends of the other tree's wide levels
} Team;

/// Tests each leaf of a block against the half of the block that follows it cyclically. Returns the number of buffered pairs.
static inline uint meet_within(local Team *team, SINK_PARAMETERS, uint kept_count, const uint count)
{
    EACH (k) {
        const Aabb box = load_local_box(team->own, k);
        uint behind = 0u;  // bit s: overlaps leaf k + s + 1, cyclically
#pragma unroll
        for (uint step = 0u; step < BLOCK / 2u; ++step)
            if (overlap(box, load_local_box(team->own, (k + step + 1u) % BLOCK)))
                behind |= 1u << step;
        if (k >= BLOCK / 2u)  // the opposite leaf counts this pair
            behind &= ~(1u << (BLOCK / 2u - 1u));
        const uint hits = rotate(behind, k + 1u) & (0xffffffffu >> (BLOCK - count));
        kept_count =
            put_hits(SINK, kept_count, team->own_ids[k], team->own_ids, k < count ? hits : 0u);
    }
    return kept_count;
}

/// Tests the block's `own_count` leaves against `count` (1 to 32) others from `first` on. Returns the number of buffered pairs.
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

/// True if one of a block's boxes overlaps `box`.
static inline bool meets_any(local const BoxWord *boxes, const Aabb box)
{
    bool meets = false;
#pragma unroll 8
    for (uint k = 0u; k < BLOCK; ++k)
        meets |= overlap(load_local_box(boxes, k), box);
    return meets;
}

/// Loads the leaves of a task into `team`. True if their common box is loose (LOOSE).
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

/// Initialises the stack: with the root, and in the block's own tree with its ancestors on wide levels, the nearest last.
/// `own_leaf` is the label of the block's first leaf, 0 in another object's tree. Returns the number of entries.
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
        team->stack[k] = ENTRY(wide_levels - k, node);
    }
    for (uint k = lane; k < max(wide_levels, 1u); k += LANES) {
        team->rows[k] = tree_row(TREE, leaf_level - BLOCK_LEVELS * k);
        team->ends[k] = tree_row_end(TREE, leaf_level - BLOCK_LEVELS * k);
    }
    team_fence();
    return depth;
}

/// Finds the pairs of a task's leaves. Returns the number of box tests, which exceeds 32 bits if the block's box overlaps some 10^8
/// leaves.
static inline ulong walk_block(FOREST_PARAMETERS, local Team *team, SINK_PARAMETERS,
                               const QueryTask task, const Aabb common)
{
    const bool is_own = task.own == task.other;
    const bool is_loose = load_block(FOREST, team, lane, task, common);
    PICK_TREE(task.other)
    const uint leaf_level = ceil_log2(leaves);
    const uint own_leaf = is_own ? tree_leaf(TREE, task.first) : 0u;
    uint tests = 0u, met = 0u, kept_count = 0u, seen = 0u;
    if (is_own) {
        kept_count = meet_within(team, SINK, kept_count, task.count);
        tests = task.count * (task.count - 1u) / 2u;
    }
    uint waiting = open_walk(TREE, team, lane, own_leaf);
    while (waiting > 0u) {
        --waiting;
        const uint entry = team->stack[waiting], node = NODE_OF(entry);
        const uint wide = max(WIDE_OF(entry), 1u) - 1u;  // wide level of the descendants
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
            met += many;
            kept_count = meet_seen(team, SINK, TREE, kept_count, task.count, seen, many);
        }
    }
    close_sink(SINK, kept_count);
    return tests + (ulong)met * task.count;
}

static inline Aabb block_box(FOREST_PARAMETERS, const QueryTask task)
{
    PICK_TREE(task.own)
    return tree_box(TREE, tree_ancestor(TREE, tree_leaf(TREE, task.first), BLOCK_LEVELS));
}

/// One team per task. `counters` are zero but for what between.cl added. `pairs` receives what fits; everything is counted.
__attribute__((reqd_work_group_size(TEAMS * LANES, 1, 1))) kernel void block_pairs(
    FOREST_PARAMETERS, global const uint *ropes, global const Face *faces, global uint2 *pairs,
    const uint capacity, volatile global uint *counters, TASKS_PARAMETERS)
{
    local Team teams[TEAMS];
    local ulong tests[TEAMS];
    (void)ropes;
    const uint lane = (uint)get_local_id(0) % LANES, own = (uint)get_local_id(0) / LANES;
    local Team *team = teams + own;
    local uint2 *kept = team->kept;
    const QueryTask task = task_of(TASKS, counters, (uint)get_group_id(0) * TEAMS + own);
    ulong tested = 0ul;
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
