// SPDX-License-Identifier: MIT
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=0 -DTEAMS=1 -DTEAM_LEAVES=128u
// check: -DCODE_WORDS=2 -DSORTED_LEAVES=1 -DTEAMS=2 -DTEAM_LEAVES=32u
//
// [Benthin2024]: the tree of clusters.h in one launch. As published, teams work on ranges together, one lane's after the other's,
// and the second child of a range to arrive joins it.
//
// Unlike there, a team has TEAM_LEAVES leaves, and joins all ranges of these alone in local memory. The lowest ranges are found from the codes alone: a lane looks at most RANGE_CLUSTERS leaves to both sides of its
// split. Only children that are not found so arrive at their parents, about one node in 16, and a team climbs as one.
//
// A node has the number of a leaf, less one: each cluster is told from others by one of its leaves, and a joined cluster keeps
// that of its first part, so that of the second is free and names the node. Numbers do not depend on which team was first, no
// counter is shared, and nodes are stored near their leaves. A cluster's leaf is its lowest.
#include "baselines/hploc/ranges.clh"
#include "baselines/hploc/team.clh"

/// The cluster in the lane's place of a list.
typedef struct {
    Aabb box;
    uint node, leaf;
} Cluster;

/// Returns the cluster of lane `from`.
static inline Cluster cluster_from(const Team team, const Cluster own, const uint from)
{
    Cluster cluster;
    cluster.box = box_of(team, own.box, from);
    cluster.node = word_of(team, own.node, from);
    cluster.leaf = word_of(team, own.leaf, from);
    return cluster;
}

/// Returns the smallest key of the lane's cluster. Each pair's key is computed by the first of both. All boxes are asked for before
/// any key is handed over, so that no key waits for another. Lanes wrap around: those behind the last cluster have NO_KEY to give.
static inline uint chosen(const Team team, const Aabb box, const uint count)
{
    uint keys[SEARCH_RADIUS], best = NO_KEY;
#pragma unroll
    for (uint step = 1u; step <= SEARCH_RADIUS; ++step) {
        const uint other = team.lane + step;
        const Aabb other_box = box_of(team, box, other);
        const uint key = cluster_key(box, other_box, team.lane, other);
        keys[step - 1u] = other < count ? key : NO_KEY;
        best = min(best, keys[step - 1u]);
    }
#pragma unroll
    for (uint step = 1u; step <= SEARCH_RADIUS; ++step)
        best = min(best, word_of(team, keys[step - 1u], team.lane - step));
    return best;
}

/// Joins clusters that choose each other, writes their nodes, and returns the number of clusters left.
static inline uint join_once(const Build build, const Team team, Cluster* list, const uint count)
{
    const uint best = chosen(team, list->box, count);
    const uint partner = partner_of(best, team.lane);
    const uint best_of_partner = word_of(team, best, partner);
    const Cluster other = cluster_from(team, *list, partner);
    const bool is_there = team.lane < count, joins = is_there && best == best_of_partner;
    Cluster joined = *list;
    if (joins && team.lane < partner) {
        const uint number = other.leaf - 1u;
        joined.box = merged(joined.box, other.box);
        store_node(build.nodes, number, joined.box, joined.node, other.node);
        joined.node = number;
    }
    const bool stays = is_there && (!joins || team.lane < partner);
    const uint all = team_votes(team, stays);
    if (stays)
        team.words[popcount(all & ((1u << team.lane) - 1u))] = team.lane;
    team_barrier();
    const uint from = team.words[team.lane];
    team_barrier();
    *list = cluster_from(team, joined, from);
    return (uint)popcount(all);
}

/// Adds the clusters of a child of `range` to a list of `own` clusters: of the left child to its front, of the right child to its end.
/// Returns the number of all.
static inline uint add_child(const Build build, const Team team, Cluster* list, const uint own,
                             const Range range, const bool is_left)
{
    const uint first = is_left ? range.first : range.split + 1u;
    const uint size = is_left ? range.split - range.first + 1u : range.last - range.split;
    const uint k = is_left ? team.lane : team.lane - own;
    uint2 cluster = (uint2)(0u, 0u);
    if (k <
        min(size, RANGE_CLUSTERS))  // before their number is known, so that both are read at once
        cluster = cluster_of(build, range, first, size, k);
    const uint added = cluster_count(build, range, first, size);
    if (is_left && own != 0u)
        *list = cluster_from(team, *list, team.lane - added);
    if (k < added) {
        list->box = box_of_cluster(build, range.common, first + k, cluster.x);
        list->node = cluster.x;
        list->leaf = cluster.y;
    }
    return own + added;
}

/// Joins a range and all above it whose other child has arrived. The barriers order the writes of all lanes before the arrival
/// of the first, and the reads of all lanes after it (device/handoff.clh).
static inline void climb_from(const Build build, const Team team, Range range, global uint* root,
                              global ForestObject* objects)
{
    Cluster list = {empty_box(), 0u, 0u};
    uint count = add_child(build, team, &list, 0u, range, true);
    count = add_child(build, team, &list, count, range, false);
    while (count != 0u) {
        const uint most = is_whole(build, range) ? 1u : RANGE_CLUSTERS;
        while (count > most)
            count = join_once(build, team, &list, count);
        if (team.lane < count)
            store_cluster(build, range, team.lane, count, list.box, (uint2)(list.node, list.leaf));
        if (most == 1u && team.lane == 0u)
            store_root(build, range, list.node, root, objects);
        if (range.before == range.after)  // all leaves: both are 0
            return;
        uint end = 0u;
        team_barrier();
        if (team.lane == 0u)
            end = arrive(build, range);
        end = word_of(team, end, 0u);
        team_barrier();
        const bool is_right = range.before > range.after;
        range = parent_of(build, range, end);
        count = end == 0u ? 0u : add_child(build, team, &list, count, range, is_right);
    }
}

/// Joins the ranges whose left children end at the team's 32 leaves from `first` on, and those above them.
static inline void build_from(Build build, const Team team, const uint first, global uint* root,
                              global ForestObject* objects)
{
    const uint split = first + team.lane, leaves = build.leaves;
    uint outside = 0u;
    Range own = no_range();
    if (split + 1u < leaves) {
        outside = max(common_of(build.codes, leaves, split, build.begin - 1u),
                      common_of(build.codes, leaves, split, build.begin + TEAM_LEAVES));
        build.outside = outside;
        own = range_at(build, split);
    }
    team_barrier();
    uint waiting = team_votes(team, own.last != 0u);
    while (waiting != 0u) {
        const uint from = lowest_bit(waiting);
        waiting &= waiting - 1u;
        Range range;
        range.first = word_of(team, own.first, from);
        range.split = word_of(team, own.split, from);
        range.last = word_of(team, own.last, from);
        range.common = word_of(team, own.common, from);
        range.before = word_of(team, own.before, from);
        range.after = word_of(team, own.after, from);
        build.outside = word_of(team, outside, from);
        climb_from(build, team, range, root, objects);
    }
}

/// Builds the tree over the ascending `codes` into `nodes`, with a team for TEAM_LEAVES leaves, and writes `root` and the roots of
/// objects with several leaves. `ends` has one entry per gap, zero before and after; `clusters` has one per leaf.
__attribute__((reqd_work_group_size(TEAMS * TEAM_SIZE, 1, 1))) kernel void build(
    global const Code* restrict codes, global const BoxWord* restrict leaf_boxes,
    global const uint* restrict ids, global RadixWord* nodes, global uint2* clusters,
    volatile global Arrivals* ends, global uint* root, global ForestObject* objects,
    const uint leaves, const uint root_common)
{
    local uint words[TEAMS * TEAM_SIZE];
    local TeamLeaves own[TEAMS];
    const uint item = (uint)get_local_id(0), k = item / TEAM_SIZE;
    const Team team = {words + k * TEAM_SIZE, item % TEAM_SIZE};
    const uint begin = (uint)get_global_id(0) / TEAM_SIZE * TEAM_LEAVES;
    const Build build = {codes,  leaf_boxes,  ids,     nodes, clusters, ends,
                         leaves, root_common, own + k, begin, 0u};
    for (uint place = team.lane; place < TEAM_LEAVES; place += TEAM_SIZE) {
        own[k].ends[place] = 0u;
        if (begin + place < leaves)
            store_local_box(own[k].boxes, place, leaf_box(leaf_boxes, ids, begin + place));
    }
    team_barrier();
    for (uint first = begin; first < begin + TEAM_LEAVES; first += TEAM_SIZE)
        build_from(build, team, first, root, objects);
}
