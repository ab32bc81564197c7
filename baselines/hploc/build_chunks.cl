// SPDX-License-Identifier: MIT
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=0
// check: -DCODE_WORDS=2 -DSORTED_LEAVES=1
//
// The chunk form of build_groups.cl: a work-item joins a range alone.
#include "baselines/hploc/ranges.clh"

// Keys of a radius are computed for this many places at once. Places behind the list hold boxes of no meaning.
#define AT_ONCE 8u
#define ROOM (MOST_CLUSTERS + SEARCH_RADIUS)

/// A list of clusters, sides apart from each other so that neighbouring places are read at once.
typedef struct {
    float min_x[ROOM], min_y[ROOM], min_z[ROOM], max_x[ROOM], max_y[ROOM], max_z[ROOM];
    uint node[MOST_CLUSTERS], leaf[MOST_CLUSTERS];
    uint best[ROOM], keys[MOST_CLUSTERS];
} List;

static inline Aabb box_at(const List* list, const uint k)
{
    const Aabb box = {list->min_x[k], list->min_y[k], list->min_z[k],
                      list->max_x[k], list->max_y[k], list->max_z[k]};
    return box;
}

static inline void set_box(List* list, const uint k, const Aabb box)
{
    list->min_x[k] = box.min_x;
    list->min_y[k] = box.min_y;
    list->min_z[k] = box.min_z;
    list->max_x[k] = box.max_x;
    list->max_y[k] = box.max_y;
    list->max_z[k] = box.max_z;
}

/// Writes to `best` the smallest key of each cluster.
static inline void choose(List* list, const uint count)
{
    const uint padded = divided_up(count, AT_ONCE) * AT_ONCE;
    for (uint k = 0u; k < padded; ++k)
        list->best[k] = NO_KEY;
    for (uint step = 1u; step <= SEARCH_RADIUS; ++step) {
        for (uint k = 0u; k < padded; ++k) {
            const uint key = cluster_key(box_at(list, k), box_at(list, k + step), k, k + step);
            list->keys[k] = k + step < count ? key : NO_KEY;
        }
        for (uint k = 0u; k < padded; ++k)
            list->best[k] = min(list->best[k], list->keys[k]);
        for (uint k = 0u; k < padded; ++k)
            list->best[k + step] = min(list->best[k + step], list->keys[k]);
    }
}

/// Writes the node of the clusters at two places. Returns its number.
static inline uint joined(const Build build, const List* list, const uint k, const uint partner)
{
    const uint number = list->leaf[partner] - 1u;
    store_node(build.nodes, number, merged(box_at(list, k), box_at(list, partner)), list->node[k],
               list->node[partner]);
    return number;
}

/// Joins clusters that chose each other, writes their nodes, and returns the number of clusters left. There is no `continue` in the
/// loop: Mesa 22.3 compiles it wrongly for llvmpipe.
static inline uint join(const Build build, List* list, const uint count)
{
    uint left = 0u;
    for (uint k = 0u; k < count; ++k) {
        const uint partner = partner_of(list->best[k], k);
        const bool joins = list->best[partner] == list->best[k];
        if (!joins || k < partner) {  // else it is joined already
            const Aabb box = box_at(list, k), other = joins ? box_at(list, partner) : box;
            list->node[left] = joins ? joined(build, list, k, partner) : list->node[k];
            list->leaf[left] = list->leaf[k];
            set_box(list, left++, merged(box, other));
        }
    }
    return left;
}

/// Adds the clusters of a child of `range` to the list. Returns the number of clusters in it.
static inline uint append(const Build build, List* list, uint count, const Range range,
                          const uint first, const uint size)
{
    const uint own = cluster_count(build, range, first, size);
    for (uint k = 0u; k < own; ++k, ++count) {
        const uint2 cluster = cluster_of(build, range, first, size, k);
        list->node[count] = cluster.x;
        list->leaf[count] = cluster.y;
        set_box(list, count, box_of_cluster(build, range.common, first + k, cluster.x));
    }
    return count;
}

/// Joins the clusters of a range, and stores what is left.
static inline void join_range(const Build build, List* list, const Range range, global uint* root,
                              global ForestObject* objects)
{
    uint count = append(build, list, 0u, range, range.first, range.split - range.first + 1u);
    count = append(build, list, count, range, range.split + 1u, range.last - range.split);
    const uint most = is_whole(build, range) ? 1u : RANGE_CLUSTERS;
    while (count > most) {
        choose(list, count);
        count = join(build, list, count);
    }
    for (uint k = 0u; k < count; ++k)
        store_cluster(build, range, k, count, box_at(list, k),
                      (uint2)(list->node[k], list->leaf[k]));
    if (most == 1u)
        store_root(build, range, list->node[0], root, objects);
}

/// As `build` in build_groups.cl.
kernel void build(global const Code* restrict codes, global const BoxWord* restrict leaf_boxes,
                  global const uint* restrict ids, global RadixWord* nodes, global uint2* clusters,
                  volatile global Arrivals* ends, global uint* root, global ForestObject* objects,
                  const uint leaves, const uint root_common)
{
    const Build build = {codes, leaf_boxes, ids, nodes, clusters, ends, leaves, root_common};
    const Chunk chunk = own_chunk(leaves - 1u);
    List list;
    for (uint k = 0u; k < ROOM; ++k)
        set_box(&list, k, empty_box());
    for (uint split = chunk.first; split < chunk.end; ++split) {
        Range range = range_at(build, split);
        while (range.last != 0u) {
            join_range(build, &list, range, root, objects);
            range = range.before == range.after ? no_range()
                                                : parent_of(build, range, arrive(build, range));
        }
    }
}
