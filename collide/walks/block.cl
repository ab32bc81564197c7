// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DTEAMS=1u -DLOOSE=4u -DTEAMS_A_TASK=2u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DTEAMS=4u -DLOOSE=4u -DTEAMS_A_TASK=1u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DTEAMS=4u -DLOOSE=4u -DTEAMS_A_TASK=1u -DBOX_FORMAT=1u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DTEAMS=4u -DLOOSE=4u -DTEAMS_A_TASK=1u -DBOX_FORMAT=2u
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DTEAMS=1u -DLOOSE=4u -DTEAMS_A_TASK=2u -DCLASSES=5u
// check: -include baselines/hploc/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=0 -DTEAMS=1u -DLOOSE=4u -DTEAMS_A_TASK=2u -DCLASSES=5u
// check: -include oibvh/wide/wide4_access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=0 -DTEAMS=1u -DLOOSE=4u -DTEAMS_A_TASK=2u -DCLASSES=5u
//
// A team queries the tree with a block: up to 32 neighbouring leaves, in an implicit tree a subtree. It traverses the tree as one of
// nodes with up to 32 children: those of an implicit binary tree are found by arithmetic (block_implicit.clh), others were collapsed
// before (block_collapsed.clh). Each lane tests one child against the block's box. Leaves that overlap it are collected; once
// there are 32, each lane tests its own leaf of the block against all of them.
//
// In its own tree, a block is tested only against what follows it, so each pair of blocks is met once. Where the order of leaves
// jumps, a block's box spans distant places: if its area is more than LOOSE times the summed area of its leaves, a node must also
// overlap one of the leaves.
//
// The traversal is depth-first, last node first.
//
// TEAMS_A_TASK teams share a task: of the nodes above the leaves each takes those whose number is its own modulo TEAMS_A_TASK, and
// only the first tests the block's leaves against each other. All take the steps above. So long walks end sooner where there are few.
//
// `pairs`, `counters` and the tasks are as in group_groups.cl. Teams of a group synchronise only to add up their box tests.
#include "collide/walks/block_team.clh"
#include "collide/walks/task.clh"
#if TREE_COLLAPSED
#include "collide/walks/block_collapsed.clh"
#else
#include "collide/walks/block_implicit.clh"
#endif

#if LANES != 1u && LANES != TEAM_LANES
#error "the host launches TEAM_LANES work-items a team"
#endif

/// Loads the leaves of a task into `team` and their common box into `common`. True if that is loose (LOOSE).
static inline bool load_block(FOREST_PARAMETERS WALK_PARAMETERS, local Team *team, const uint lane,
                              global const Face *faces, const QueryTask task, Aabb *common)
{
    PICK_TREE(task.own)
    const uint row = leaf_row(TREE);
    Aabb part = empty_box();
    float area = 0.0f;
    EACH (k) {
        const uint leaf = own_leaf(TREE WALK, task.first, min(k, task.count - 1u));
        const Aabb box = leaf_box_at(TREE, row, leaf);
        put_box(team->own_low, team->own_high, k, box);
        team->own_ids[k] = tree_triangle(TREE, leaf);
        area += half_surface(box);
        part = merged(part, box);
    }
    *common = common_box(TREE, team, lane, tree_leaf(TREE, task.first), part);
    load_faces(team->own_faces, team->own_ids, lane, faces, BLOCK);
    return half_surface(*common) > LOOSE * team_sum(area);
}

/// Finds the pairs of a task's leaves that fall to the team of number `share` (TEAMS_A_TASK). Returns the number of box tests, which
/// exceeds 32 bits if the block's box overlaps some 10^8 leaves.
static inline ulong walk_block(FOREST_PARAMETERS WALK_PARAMETERS, local Team *team, SINK_PARAMETERS,
                               global const Face *faces, const QueryTask task, const uint share)
{
    Aabb common;
    const bool is_own = task.own == task.other;
    const bool is_loose = load_block(FOREST WALK, team, lane, faces, task, &common);
    PICK_TREE(task.other)
    uint tests = 0u, met = 0u, kept_count = 0u, seen = 0u;
    if (is_own && share == 0u) {
        kept_count = meet_within(team, SINK, kept_count, task.count);
        tests = task.count * (task.count - 1u) / 2u;
    }
    uint waiting = open_walk(TREE WALK, team, lane, task);
    const uint own_end = is_own ? first_position(TREE) + task.first + task.count : 0u;
    if (share > 0u && leaves <= BLOCK)  // no nodes above the leaves to share
        waiting = 0u;
    while (waiting > 0u) {
        --waiting;
        const Step step = step_of(team, waiting, own_end);
        tests += tests_of(step);
        waiting = put_rest(team, lane, waiting, step);
        EACH (k) {
            const uint tested = tested_by(step, k);
            Entry entry;
            const Aabb box = tested_box(TREE WALK, step, tested, &entry);
            const uint leaf = is_of_leaves(step) ? leaf_of(TREE WALK, tested) : 0u;
            const uint triangle = is_of_leaves(step) ? tree_triangle(TREE, leaf) : 0u;
            bool meets = is_tested(TREE WALK, step, k, tested) && overlap(common, box) &&
                         (!is_above_leaves(step, entry) || tested % TEAMS_A_TASK == share);
            if (is_loose && meets)
                meets = meets_any(team, box);
            const uint votes = team_vote(meets);  // by now all lanes have read the entry
            if (!is_of_leaves(step)) {
                if (meets)
                    team->stack[waiting + lanes_before(votes)] = entry;
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
    global uint *next_counters, const uint counter_count WALK_PARAMETERS)
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
        tested = walk_block(FOREST WALK, team, SINK, faces, task, index % TEAMS_A_TASK);
    if (lane == 0u)
        tests[own] = tested;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (get_local_id(0) == 0) {
        ulong sum = 0ul;
        for (uint k = 0u; k < TEAMS; ++k)
            sum += tests[k];
        add_wide(counters + BOX_TESTS_COUNT, sum);
        if (get_group_id(0) == 0)
            count_collapsed(counters WALK);
    }
}
