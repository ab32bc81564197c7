// SPDX-License-Identifier: MIT
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=0 -DTEAMS=1
// check: -DCODE_WORDS=2 -DSORTED_LEAVES=1 -DTEAMS=2
//
// [Benthin2024]: the tree of clusters.h in one launch. As published, teams work on ranges together, one lane's after the other's,
// and the second child of a range to arrive joins it.
//
// Unlike there, the lowest ranges are found from the codes alone: a lane looks at most RANGE_CLUSTERS leaves to both sides of its
// split. Only children that are not found so arrive at their parents, about one node in 16, and a team climbs as one.
//
// A node has the number of a leaf, less one: each cluster is told from others by one of its leaves, and a joined cluster keeps
// that of its first part, so that of the second is free and names the node. Numbers do not depend on which team was first, no
// counter is shared, and nodes are stored near their leaves. A cluster's leaf is its lowest.
#include "baselines/hploc/ranges.clh"
#include "baselines/hploc/team.clh"

// Places, and so many more that each lane can read those behind its own; what it finds behind the list has no meaning.
#define ROOM (TEAM_SIZE + SEARCH_RADIUS)

/// A list of clusters, and what the lanes of a team exchange.
typedef struct {
    float min_x[ROOM], min_y[ROOM], min_z[ROOM], max_x[ROOM], max_y[ROOM], max_z[ROOM];
    uint node[TEAM_SIZE], leaf[TEAM_SIZE];
    uint keys[SEARCH_RADIUS * ROOM];  ///< of each place and the one `step` before it, step by step
    uint best[TEAM_SIZE];             ///< smallest key of each place
    Range range;
    uint end;
} Team;

static inline Aabb box_at(local const Team* team, const uint k)
{
    const Aabb box = {team->min_x[k], team->min_y[k], team->min_z[k],
                      team->max_x[k], team->max_y[k], team->max_z[k]};
    return box;
}

static inline void set_cluster(local Team* team, const uint k, const Aabb box, const uint2 cluster)
{
    team->min_x[k] = box.min_x;
    team->min_y[k] = box.min_y;
    team->min_z[k] = box.min_z;
    team->max_x[k] = box.max_x;
    team->max_y[k] = box.max_y;
    team->max_z[k] = box.max_z;
    team->node[k] = cluster.x;
    team->leaf[k] = cluster.y;
}

/// Returns the smallest key of the lane's cluster. Each pair's key is computed by the first of both. There are no branches, so that
/// all reads can be under way at once.
static inline uint chosen(local Team* team, const uint lane, const uint count)
{
    const Aabb box = box_at(team, lane);
    uint best = NO_KEY;
#pragma unroll
    for (uint step = 1u; step <= SEARCH_RADIUS; ++step) {
        const uint other = lane + step;
        const uint key = cluster_key(box, box_at(team, other), lane, other);
        const uint if_there = other < count ? key : NO_KEY;
        team->keys[(step - 1u) * ROOM + other] = if_there;
        best = min(best, if_there);
    }
    team_barrier();
#pragma unroll
    for (uint step = 1u; step <= SEARCH_RADIUS; ++step) {
        const uint key = team->keys[(step - 1u) * ROOM + lane];
        best = min(best, lane >= step ? key : NO_KEY);
    }
    return best;
}

/// Joins clusters that choose each other, writes their nodes, and returns the number of clusters left. The list is written.
static inline uint join_once(const Build build, local Team* team, const uint lane, const uint count)
{
    const uint best = chosen(team, lane, count);
    team->best[lane] = best;
    team_barrier();
    const uint partner = partner_of(best, lane);
    const bool is_there = lane < count, joins = is_there && team->best[partner] == best;
    Aabb box = box_at(team, lane);
    uint2 cluster = (uint2)(team->node[lane], team->leaf[lane]);
    if (joins && lane < partner) {
        const uint number = team->leaf[partner] - 1u;
        box = merged(box, box_at(team, partner));
        store_node(build.nodes, number, box, cluster.x, team->node[partner]);
        cluster.x = number;
    }
    const bool stays = is_there && (!joins || lane < partner);
    const uint all = team_votes(team->keys, lane, stays);
    team_barrier();
    if (stays)
        set_cluster(team, (uint)popcount(all & ((1u << lane) - 1u)), box, cluster);
    team_barrier();
    return (uint)popcount(all);
}

/// Loads the clusters of both children, half of the lanes each. Returns their number.
static inline uint load_clusters(const Build build, local Team* team, const uint lane,
                                 const Range range)
{
    const bool are_whole = joins_objects(build, range);
    const uint left_size = range.split - range.first + 1u, right_size = range.last - range.split;
    const bool is_left = lane < RANGE_CLUSTERS;
    const uint k = lane % RANGE_CLUSTERS;
    const uint first = is_left ? range.first : range.split + 1u;
    const uint size = is_left ? left_size : right_size;
    uint2 cluster = (uint2)(0u, 0u);
    if (k < size)  // before the number of clusters is known, so that both are read at once
        cluster = cluster_of(build, first, size, are_whole, k);
    const uint left = cluster_count(build, range.first, left_size, are_whole);
    const uint right = cluster_count(build, range.split + 1u, right_size, are_whole);
    if (k < (is_left ? left : right))
        set_cluster(team, (is_left ? 0u : left) + k, box_of_cluster(build, cluster.x), cluster);
    team_barrier();
    return left + right;
}

/// Joins the clusters of a range, and stores what is left.
static inline void join_range(const Build build, local Team* team, const uint lane,
                              const Range range, global uint* root, global ForestObject* objects)
{
    const uint most = is_whole(build, range) ? 1u : RANGE_CLUSTERS;
    uint count = load_clusters(build, team, lane, range);
    while (count > most)
        count = join_once(build, team, lane, count);
    if (lane < count)
        store_cluster(build, range, lane, count, (uint2)(team->node[lane], team->leaf[lane]));
    if (most == 1u && lane == 0u)
        store_root(build, range, team->node[0], root, objects);
}

/// Joins a range and all above it whose other child has arrived. The barriers order the writes of all lanes before the exchange
/// of the first, and the reads of all lanes after it (device/handoff.clh).
static inline void climb_from(const Build build, local Team* team, const uint lane, Range range,
                              volatile global Arrivals* ends, global uint* root,
                              global ForestObject* objects)
{
    while (range.last != 0u) {
        join_range(build, team, lane, range, root, objects);
        if (range.before == range.after)  // all leaves: both are 0
            return;
        team_barrier();
        if (lane == 0u)
            team->end = arrive(range, ends);
        team_barrier();
        range = parent_of(build, range, team->end);
    }
}

/// Builds the tree over the ascending `codes` into `nodes`, with one work-item per gap between leaves, and writes `root` and the
/// roots of objects with several leaves. `ends` has one entry per gap, zero before and after; `clusters` has one per leaf.
__attribute__((reqd_work_group_size(TEAMS * TEAM_SIZE, 1, 1))) kernel void build(
    global const Code* restrict codes, global const BoxWord* restrict leaf_boxes,
    global const uint* restrict ids, global RadixWord* nodes, global uint2* clusters,
    volatile global Arrivals* ends, global uint* root, global ForestObject* objects,
    const uint leaves, const uint root_common)
{
    local Team teams[TEAMS];
    local Team* team = &teams[(uint)get_local_id(0) / TEAM_SIZE];
    const uint lane = (uint)get_local_id(0) % TEAM_SIZE, split = (uint)get_global_id(0);
    const Build build = {codes, leaf_boxes, ids, nodes, clusters, leaves, root_common};
    Range own = no_range();
    if (split + 1u < leaves)
        own = range_at(build, ends, split);
    uint waiting = team_votes(team->keys, lane, own.last != 0u);
    while (waiting != 0u) {
        const uint from = lowest_bit(waiting);
        waiting &= waiting - 1u;
        if (lane == from)
            team->range = own;
        team_barrier();
        climb_from(build, team, lane, team->range, ends, root, objects);
    }
}
