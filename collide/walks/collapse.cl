// SPDX-License-Identifier: MIT
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=0 -DGROUP_SIZE=256u -DWORDS_PER_ITEM=4u -DSTATE_EPOCH_BITS=31u -DNUMBERED_BY_RANGE=1
// check: -include baselines/hploc/access.clh -DSORTED_LEAVES=1 -DGROUP_SIZE=256u -DWORDS_PER_ITEM=4u -DSTATE_EPOCH_BITS=31u -DNUMBERED_BY_RANGE=0
// check: -include baselines/radix/access_apetrei.clh -DSORTED_LEAVES=1 -DGROUP_SIZE=256u -DWORDS_PER_ITEM=4u -DSTATE_EPOCH_BITS=31u -DNUMBERED_BY_RANGE=0
//
// Collapses a binary tree with pointers into wide nodes above small subtrees: the largest ones of at most
// BLOCK_LEAVES leaves. A wide node is a subtree whose class (wide_node.h) is below its parent's; its children are the largest subtrees
// below it of a lower class than its own. So if an inner node of class c has a child of a lower class, that one is a child of the wide
// node that both are in. All such children are list c - 1, in the order of their leaves: the children of a wide node follow each other.
//
//     mark     the first and the last leaf of each inner node; line_up.cl finds them if leaves are not in the tree's order. One bit for
//              each leaf in each list: whether a subtree of the list begins there
//     count    how many bits there are before each word, and so a subtree's place in its list
//     fill     the lists, and the objects' roots
#include "builders/stages/chunk.clh"
#include "builders/stages/group_scan.clh"
#include "builders/stages/sort/look_back.clh"
#include "collide/tree.clh"
#include "collide/walks/wide_node.h"

#define WORD_BITS 32u
#define TILE (GROUP_SIZE * WORDS_PER_ITEM)

/// Position of a leaf among all leaves in the order of the tree; `positions` has those of all places if they are others.
static inline uint position_of(TREE_PARAMETERS, global const uint* positions, const uint leaf)
{
    const uint place = tree_number(TREE, leaf) - (all_leaves - 1u);
    return TREE_IN_ORDER ? place : positions[place];
}

// The range of leaves of an inner node. If nodes are numbered by range (builders/device_tree.h), its number is one end: the other is kept.
#if NUMBERED_BY_RANGE
typedef uint Ends;
#else
typedef uint2 Ends;
#endif

static inline uint2 range_of(global const Ends* ends, const uint k)
{
#if NUMBERED_BY_RANGE
    return (uint2)(min(k, ends[k]), max(k, ends[k]));
#else
    return ends[k];
#endif
}

/// Returns the last leaf of the subtree at `node`, or the first one, by a walk down.
static inline uint end_below(TREE_PARAMETERS, global const uint* positions, uint node,
                             const bool is_last)
{
    while (!tree_is_leaf(TREE, node))
        node = is_last ? tree_right(TREE, node) : tree_left(TREE, node);
    return position_of(TREE, positions, node);
}

/// Returns the last leaf of a left child.
static inline uint last_of(TREE_PARAMETERS, global const uint* positions, global const Ends* ends,
                           const uint left)
{
    if (NUMBERED_BY_RANGE && !tree_is_leaf(TREE, left))
        return tree_number(TREE, left);
    return TREE_IN_ORDER || tree_is_leaf(TREE, left) ? end_below(TREE, positions, left, true)
                                                     : range_of(ends, tree_number(TREE, left)).y;
}

/// Finds the range of inner node number k of a tree whose leaves are in its order, and writes it to `ends`.
static inline void find_range(TREE_PARAMETERS, global Ends* ends, const uint k)
{
    const uint node = tree_inner(TREE, k);
    const uint left = tree_left(TREE, node), right = tree_right(TREE, node);
#if NUMBERED_BY_RANGE
    const bool is_first = last_of(TREE, 0, ends, left) >= k;
    ends[k] = end_below(TREE, 0, is_first ? right : left, is_first);
#else
    ends[k] = (Ends)(end_below(TREE, 0, left, false), end_below(TREE, 0, right, true));
#endif
}

/// True if a child with `leaves` leaves of a node of class `class` is in list class - 1.
static inline bool is_listed(const uint leaves, const uint class)
{
    return wide_class(leaves) < class;
}

static inline void put_bit(volatile global uint* list, const uint position)
{
    atomic_or(list + position / WORD_BITS, 1u << (position % WORD_BITS));
}

/// `marks` are lists of `words` words each, and a word more. They are zero before, and zeroed again by `count_before`.
kernel void mark(FOREST_PARAMETERS, global const uint* positions, global Ends* ends,
                 volatile global uint* marks, const uint words)
{
    PICK_WHOLE_TREE(void) objects;
    const Chunk chunk = own_chunk(leaves - 1u);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        if (TREE_IN_ORDER)
            find_range(TREE, ends, k);
        const uint2 range = range_of(ends, k);
        const uint class = wide_class(range.y - range.x + 1u);
        if (class == 0u)
            continue;
        const uint split = last_of(TREE, positions, ends, tree_left(TREE, tree_inner(TREE, k)));
        volatile global uint* list = marks + (ulong)(class - 1u) * words;
        if (is_listed(split - range.x + 1u, class))
            put_bit(list, range.x);
        if (is_listed(range.y - split, class))
            put_bit(list, split + 1u);
    }
}

/// A word of marks, and how many bits there are before it in all lists.
typedef struct {
    uint before, bits;
} Counted;

/// Writes to `counts` what there is in and before each of the `count` words of `marks`, and zeroes them. A group takes a tile of WORDS_PER_ITEM words
/// for each work-item, and looks back for those before; a single group takes all tiles in turn. `states` has a state for each tile, and
/// no earlier launch has used `epoch` (look_back.clh). `tiles_taken` is 0, and zeroed again by `fill`.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void count_before(
    global uint* marks, global Counted* counts, const uint count, volatile global ulong* states,
    const uint epoch, volatile global uint* tiles_taken)
{
    local uint scratch[SCAN_SCRATCH];
    local uint shared[2];
    const uint item = (uint)get_local_id(0);
    const bool waits = get_num_groups(0) > 1u;
    uint earlier = 0u;
    for (uint turn = 0u; turn < (waits ? 1u : divided_up(count, TILE)); ++turn) {
        if (item == 0u)
            shared[0] =
                waits ? atomic_inc(tiles_taken) : turn;  // in the order in which groups start
        barrier(CLK_LOCAL_MEM_FENCE);
        const uint tile = shared[0], first = tile * TILE + item * WORDS_PER_ITEM;
        uint bits[WORDS_PER_ITEM], sum = 0u, all;
        for (uint k = 0u; k < WORDS_PER_ITEM; ++k) {
            bits[k] = first + k < count ? marks[first + k] : 0u;
            sum += popcount(bits[k]);
        }
        uint before = sum_before(sum, scratch, &all);
        if (waits && item == 0u) {
            announce(states + tile, epoch, all, tile == 0u);
            earlier = look_back(states, tile, 1u, epoch);
            announce(states + tile, epoch, earlier + all, true);
        }
        if (item == 0u)
            shared[1] = earlier;
        barrier(CLK_LOCAL_MEM_FENCE);
        before += shared[1];
        for (uint k = 0u; k < WORDS_PER_ITEM; ++k) {
            if (first + k < count) {
                const Counted counted = {before, bits[k]};
                counts[first + k] = counted;
                marks[first + k] = 0u;
            }
            before += popcount(bits[k]);
        }
        earlier += all;
        barrier(CLK_LOCAL_MEM_FENCE);  // both words have been read
    }
}

#define LISTS_PARAMETERS global const Counted *counts, const uint words
#define LISTS counts, words

/// Returns how many bits all lists before `list`, and this one before `position`, have.
static inline uint place_of(LISTS_PARAMETERS, const uint list, const uint position)
{
    const Counted word = counts[(ulong)list * words + position / WORD_BITS];
    return word.before + popcount(word.bits & ((1u << (position % WORD_BITS)) - 1u));
}

/// Returns what the wide node over `leaves` leaves from `first` on has: its leaves or its children.
static inline uint2 below(LISTS_PARAMETERS, const uint first, const uint leaves)
{
    if (leaves <= BLOCK_LEAVES)
        return (uint2)(first, leaves | OF_LEAVES);
    const uint list = wide_class(leaves) - 1u;
    const uint begin = place_of(LISTS, list, first);
    return (uint2)(begin, place_of(LISTS, list, first + leaves) - begin);
}

/// Writes the subtree at `node`, of `leaves` leaves from `first` on, as a child to `list`.
static inline void put_child(TREE_PARAMETERS, LISTS_PARAMETERS, const uint list, const uint node,
                             const uint first, const uint count, global WideChild* wide_children,
                             global uint* child_ends)
{
    const uint place = place_of(LISTS, list, first);
    const uint2 under = below(LISTS, first, count);
    const WideChild child = {tree_box(TREE, node), under.x, under.y};
    wide_children[place] = child;
    child_ends[place] = first + count;
}

/// Writes the lists to `wide_children`, the ends of their leaves to `child_ends`, each object's root to `roots`, and how many children
/// there are to `child_count`. If there are more than `most_children`, writes none. Zeroes `tiles_taken`.
kernel void fill(FOREST_PARAMETERS, const uint object_count, global const uint* positions,
                 global const Ends* ends, LISTS_PARAMETERS, const uint lists,
                 global WideChild* wide_children, global uint* child_ends, const uint most_children,
                 global uint2* roots, global uint* child_count, global uint* tiles_taken)
{
    PICK_WHOLE_TREE
    const uint count = counts[(ulong)lists * words].before;
    if (get_global_id(0) == 0) {
        *child_count = count;
        *tiles_taken = 0u;
    }
    const Chunk chunk = own_chunk(leaves);
    for (uint k = chunk.first; count <= most_children && k < chunk.end; ++k) {
        if (k < object_count)
            roots[k] = below(LISTS, objects[k].first, objects[k].leaves);
        if (k == leaves - 1u)
            continue;
        const uint2 range = range_of(ends, k);
        const uint class = wide_class(range.y - range.x + 1u);
        if (class == 0u)
            continue;
        const uint node = tree_inner(TREE, k), left = tree_left(TREE, node);
        const uint split = last_of(TREE, positions, ends, left);
        const uint left_leaves = split - range.x + 1u, right_leaves = range.y - split;
        if (is_listed(left_leaves, class))
            put_child(TREE, LISTS, class - 1u, left, range.x, left_leaves, wide_children,
                      child_ends);
        if (is_listed(right_leaves, class))
            put_child(TREE, LISTS, class - 1u, tree_right(TREE, node), split + 1u, right_leaves,
                      wide_children, child_ends);
    }
}
