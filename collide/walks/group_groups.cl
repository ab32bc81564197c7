// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DGROUP_SIZE=64u -DFRONTIER=512u -DRESERVE=97u -DLOOSE=4u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=0 -DGROUP_SIZE=64u -DFRONTIER=512u -DRESERVE=97u -DLOOSE=4u -DBOX_FORMAT=2u
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u -DFRONTIER=512u -DRESERVE=97u -DLOOSE=4u
// check: -include baselines/hploc/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u -DFRONTIER=2048u -DRESERVE=849u -DLOOSE=4u
// check: -include baselines/radix/access_apetrei.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u -DFRONTIER=512u -DRESERVE=97u -DLOOSE=4u
//
// Queries a tree with all leaves of a task at once. Their common box descends the tree, so that a node is loaded once per group,
// and every work-item tests its own leaf against each leaf that the common box overlaps. Where the order of leaves jumps, a
// common box spans distant places and overlaps everything between: if its area is more than LOOSE times the summed area of the
// leaves, each leaf walks the tree on its own.
//
//     frontier   nodes to be tested, last first; initially what follows the task's leaves, a chain of
//                whole subtrees linked by next_node: at most as many as the tree has levels
//     met        leaves that the common box overlaps, at most two groups full; initially the task's own leaves
//
// The frontier cannot overflow: work-items take no more nodes than there is room for their children. If there is hardly any room,
// they take one node, the last, until its subtree is done; RESERVE, one more than a tree has levels, is kept free for that.
//
// An iteration has a barrier between taking and processing nodes, and one at its end. All state is in local memory.
#include "collide/sinks/sink_groups.clh"

#include "collide/walks/group_descent.clh"

/// One work-group per task. `counters` are zero but for what between.cl added. `pairs` receives what fits; everything is counted.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void group_pairs(
    FOREST_PARAMETERS, global const uint* ropes, global const Face* faces, global uint2* pairs,
    const uint capacity, volatile global uint* counters, TASKS_PARAMETERS)
{
    OPEN_SINK
    local uint tests[GROUP_SIZE];
    local float areas[GROUP_SIZE];
    local BoxWord own[3 * GROUP_SIZE], seen[3 * GROUP_SIZE], common[3];
    local uint own_ids[GROUP_SIZE], seen_ids[GROUP_SIZE], taken[GROUP_SIZE];
    local uint frontier[FRONTIER], met[2 * GROUP_SIZE];
    local uint waiting[2], met_count[2];  // of iteration t: at [t % 2]
    const uint item = (uint)get_local_id(0);
    const QueryTask task = task_of(TASKS, counters, (uint)get_group_id(0));
    const uint count = task.count;
    const bool is_own = task.own == task.other;
    PICK_TREE(task.other)

    const uint last = task.first + max(count, 1u) - 1u, place = min(task.first + item, last);
    const uint wanted = first_wanted(TREE, task, last);
    load_query(FOREST, task.own, place, own, own_ids, seen, areas);
    tests[item] = 0u;
    const bool is_loose = take_common_box(seen, areas, common);
    if (item == 0u) {
        waiting[0] =
            is_loose || count == 0u
                ? 0u
                : chain_from(TREE, ropes, first_node_of_all(TREE, ropes, task, last), frontier);
        met_count[0] = is_own ? count : 0u;
    }
    met[item] = is_own ? tree_leaf(TREE, place) : 0u;
    barrier(CLK_LOCAL_MEM_FENCE);

    for (uint turn = 0u; waiting[turn % 2u] + met_count[turn % 2u] != 0u; ++turn) {
        const uint now = turn % 2u, then = 1u - now;
        const uint nodes_there = waiting[now], leaves_there = met_count[now];
        const bool is_testing =
            leaves_there >= GROUP_SIZE || (nodes_there == 0u && leaves_there > 0u);
        const uint levels = levels_down(nodes_there);
        const uint takes = is_testing ? min(leaves_there, GROUP_SIZE) : nodes_taken(nodes_there);
        if (item < takes && is_testing) {
            const uint leaf = met[leaves_there - takes + item];
            store_local_box(seen, item, tree_box(TREE, leaf));
            seen_ids[item] = tree_triangle(TREE, leaf);
        } else if (item < takes) {
            taken[item] = frontier[nodes_there - takes + item];
        }
        if (item == 0u) {
            waiting[then] = nodes_there - (is_testing ? 0u : takes);
            met_count[then] = leaves_there - (is_testing ? takes : 0u);
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        const uint begin = is_own && turn == 0u ? item + 1u : 0u;
        if (is_testing && item < count)  // first iteration: later leaves of its own
            tests[item] +=
                test_boxes(seen, seen_ids, begin, takes, own, own_ids, item, faces, SINK);
        if (!is_testing && item < takes) {
            descend(TREE, taken[item], levels, load_local_box(common, 0u), wanted, frontier,
                    &waiting[then], met, &met_count[then]);
            ++tests[item];
        }
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    if (is_loose && item < count)
        tests[item] += walk_from(TREE, ropes, faces, SINK, load_local_box(own, item), own_ids[item],
                                 first_node_of_all(TREE, ropes, task, last), wanted);
    barrier(CLK_LOCAL_MEM_FENCE);
    count_tests(tests, counters);
    close_sink(SINK);
}
