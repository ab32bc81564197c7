// SPDX-License-Identifier: MIT
// check: -include oibvh/wide/wide4_access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DGROUP_SIZE=64u -DFRONTIER=512u -DRESERVE=97u -DLOOSE=2u
// check: -include oibvh/wide/wide8_access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u -DFRONTIER=512u -DRESERVE=97u -DLOOSE=2u
//
// As group_groups.cl, over a wide tree: a task's leaves query it at once by their common box. TREE_CHILDREN neighbouring
// work-items take one node, a child each, whose boxes are contiguous in memory.
//
//     frontier   inner nodes that the common box overlaps, last first; initially, in the leaves' own tree, all
//                ancestors of the last leaf, which need no test, so that the first iteration covers all levels at once
//     met        leaves that the common box overlaps, boxes and triangles, at most two groups full
//
// The frontier cannot overflow, as in group_groups.cl: a node taken leaves at most TREE_CHILDREN - 1 more, and RESERVE holds that
// many for every level. An iteration has one barrier between taking nodes and processing them, and one at its end.
#include "collide/sinks/sink_groups.clh"

#include "collide/walks/group_descent.clh"

/// Number of nodes that an iteration takes.
static inline uint wide_nodes_taken(const uint nodes_there)
{
    const uint kept_free = nodes_there + RESERVE;
    const uint room = kept_free < FRONTIER ? (FRONTIER - kept_free) / (TREE_CHILDREN - 1u) : 0u;
    return min(min(nodes_there, GROUP_SIZE / TREE_CHILDREN), max(room, 1u));
}

/// Tests child k of a node against the common box, unless it lies before place `first` or is an ancestor of `last_leaf`, all of
/// which start in the frontier. If they overlap, a leaf is added to the leaves met, an inner node to the frontier.
static inline void descend_to_child(TREE_PARAMETERS, const uint node, const uint k,
                                    const uint first, const uint last_leaf, const Aabb common,
                                    local uint* frontier, volatile local uint* waiting,
                                    local BoxWord* met_boxes, local uint* met_ids,
                                    volatile local uint* met_count)
{
    const uint child = (node << TREE_CHILD_BITS) + k;
    const uint above_leaves = tree_leaf_level(TREE) - tree_level(TREE, child);
    const bool is_behind = (tree_children_from(TREE, node, first) >> k & 1u) != 0u;
    if (!is_behind || last_leaf >> (TREE_CHILD_BITS * above_leaves) == child)
        return;
    const Aabb box = tree_child_box(TREE, tree_slot(TREE, node), k);
    if (!overlap(common, box))
        return;
    if (above_leaves != 0u) {
        frontier[atomic_inc(waiting)] = child;
        return;
    }
    const uint slot = atomic_inc(met_count);
    store_local_box(met_boxes, slot, box);
    met_ids[slot] = tree_triangle(TREE, child);
}

/// One work-group per task. `counters` are zero but for what between.cl added. `pairs` receives what fits; everything is counted.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void group_pairs(
    FOREST_PARAMETERS, global const uint* ropes, global const Face* faces, global uint2* pairs,
    const uint capacity, volatile global uint* counters, TASKS_PARAMETERS)
{
    OPEN_SINK
    local uint tests[GROUP_SIZE];
    local float areas[GROUP_SIZE];
    local BoxWord own[3 * GROUP_SIZE], met_boxes[6 * GROUP_SIZE], common[3];
    local uint own_ids[GROUP_SIZE], met_ids[2 * GROUP_SIZE], taken[GROUP_SIZE / TREE_CHILDREN];
    local uint frontier[FRONTIER];
    local uint waiting[2], met_count[2];  // of iteration t: at [t % 2]
    const uint item = (uint)get_local_id(0);
    const QueryTask task = task_of(TASKS, counters, (uint)get_group_id(0));
    const uint count = task.count;
    const bool is_own = task.own == task.other;
    PICK_TREE(task.other)

    const uint last = task.first + max(count, 1u) - 1u, place = min(task.first + item, last);
    load_query(FOREST, task.own, place, own, own_ids, met_boxes, areas);
    tests[item] = 0u;
    const bool is_loose = take_common_box(met_boxes, areas, common);
    const uint first = is_own ? last + 1u : 0u, last_leaf = is_own ? tree_leaf(TREE, last) : 0u;
    const uint levels_above = is_own ? tree_leaf_level(TREE) : 1u;  // other trees: from the root
    if (item == 0u) {
        waiting[0] = is_loose || count == 0u ? 0u : levels_above;
        met_count[0] = 0u;
    }
    for (uint level = item; level < levels_above; level += GROUP_SIZE)
        frontier[level] =
            is_own ? last_leaf >> (TREE_CHILD_BITS * (levels_above - level)) : tree_root(TREE);
    if (is_own && item < count)
        tests[item] += test_boxes(own, own_ids, item + 1u, count, own, own_ids, item, faces, SINK);
    barrier(CLK_LOCAL_MEM_FENCE);

    for (uint turn = 0u; waiting[turn % 2u] + met_count[turn % 2u] != 0u; ++turn) {
        const uint now = turn % 2u, then = 1u - now;
        const uint nodes_there = waiting[now], leaves_there = met_count[now];
        const bool is_testing =
            leaves_there >= GROUP_SIZE || (nodes_there == 0u && leaves_there > 0u);
        const uint takes =
            is_testing ? min(leaves_there, GROUP_SIZE) : wide_nodes_taken(nodes_there);
        if (item < takes && !is_testing)
            taken[item] = frontier[nodes_there - takes + item];
        if (item == 0u) {
            waiting[then] = nodes_there - (is_testing ? 0u : takes);
            met_count[then] = leaves_there - (is_testing ? takes : 0u);
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        if (is_testing && item < count)
            tests[item] += test_boxes(met_boxes, met_ids, leaves_there - takes, leaves_there, own,
                                      own_ids, item, faces, SINK);
        if (!is_testing && item < takes * TREE_CHILDREN) {
            descend_to_child(TREE, taken[item / TREE_CHILDREN], item % TREE_CHILDREN, first,
                             last_leaf, load_local_box(common, 0u), frontier, &waiting[then],
                             met_boxes, met_ids, &met_count[then]);
            ++tests[item];
        }
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    if (is_loose && item < count)
        tests[item] +=
            walk_of(TREE, ropes, faces, SINK, load_local_box(own, item), own_ids[item], task, last);
    barrier(CLK_LOCAL_MEM_FENCE);
    count_tests(tests, counters);
    close_sink(SINK);
}
