// SPDX-License-Identifier: MIT
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=0
// check: -DCODE_WORDS=2 -DSORTED_LEAVES=1
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=1u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=2u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=4u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=0 -DGROUP_SIZE=256u
// check: -DCODE_WORDS=2 -DSORTED_LEAVES=1 -DGROUP_SIZE=64u -DBOX_FORMAT=1u
//
// [Apetrei2014] in its fastest known form: topology and boxes in one launch, with one atomic exchange per inner node.
//
// As printed, a node's range is stored beside a counter, and boxes are read back. Here the first of two siblings stores the far
// end of its range in the slot of the gap between them; that word also shows that it has arrived. The second takes the word and
// so knows the parent's range. It keeps its own box in registers and reads only its sibling's. Nodes are numbered as in
// [Karras2012], so the ends of a range determine where a sibling is, no ranges are stored, and the root is node 0.
//
//     leaves    first ... split | split+1 ... last      ends[split]: first + 1 from the left child, or
//               left child      | right child                        last + 1 from the right; 0 from neither
//
// Leaf boxes are read in place, as in the implicit builders: copying them to nodes would write 32 bytes per leaf for nothing.
// They are input of the launch, so only boxes of inner nodes are handed over between work-items.
//
// With GROUP_SIZE, a work-group merges its own leaves in local memory first, and global atomics and fences remain for the few
// nodes whose leaves are in several groups. A leaf's ancestor with a prefix of length c has a leaf outside the group exactly if
// the leaf shares c bits or more with the last leaf before the group or the first one after it. Thus each work-item knows from
// its own leaf where local memory ends, both children of a node agree, and no barrier is needed between both parts.
#include "baselines/radix/leaves.clh"
#include "device/group_handoff.clh"
#include "device/handoff.clh"

/// The node that a work-item has reached, and common_of its first and last leaf and their outer neighbours.
typedef struct {
    uint first, last, before, after;
    Aabb box;
} Reached;

/// True if the node is a left child: its parent joins the nearer neighbour.
static inline bool is_left(const Reached at) { return at.after > at.before; }

/// Returns the last leaf of the parent's left child.
static inline uint split_above(const Reached at) { return is_left(at) ? at.last : at.first - 1u; }

/// Returns what the node stores for its sibling at the split: the parent's end on its side, plus one.
static inline uint own_end(const Reached at) { return (is_left(at) ? at.first : at.last) + 1u; }

/// Stores the node, whose left child ends at `split`.
static inline void store_reached(global RadixWord* nodes, const Reached at, const uint split)
{
    const uint place = at.before == at.after ? 0u : is_left(at) ? at.last : at.first;
    store_node(nodes, place, at.box, radix_child(split, at.first == split),
               radix_child(split + 1u, at.last == split + 1u));
}

/// Climbs until a sibling has not arrived yet or the root is built.
static inline void climb(global const Code* codes, global const BoxWord* leaf_boxes,
                         global const uint* ids, global RadixWord* nodes,
                         volatile global Arrivals* ends, const uint leaves, Reached at)
{
    while (at.before != at.after) {  // equal only at the root, where both are 0
        const uint split = split_above(at);
        const uint end = exchanged(&ends[split], own_end(at));
        if (end == 0u)
            return;
        forget_arrivals(&ends[split]);

        uint sibling;
        if (is_left(at)) {
            at.last = end - 1u;
            sibling = radix_child(split + 1u, at.last == split + 1u);
            at.after = common_of(codes, leaves, at.last, at.last + 1u);
        } else {
            at.first = end - 1u;
            sibling = radix_child(split, at.first == split);
            at.before = common_of(codes, leaves, at.first, at.first - 1u);
        }
        at.box = merged(at.box, child_box(leaf_boxes, ids, nodes, sibling));
        store_reached(nodes, at, split);
    }
}

#ifndef GROUP_SIZE

/// Builds the radix tree over the ascending `codes` into `nodes`. `ends` has one entry per gap between leaves, zero before and
/// after.
kernel void build(global const Code* restrict codes, global const BoxWord* restrict leaf_boxes,
                  global const uint* restrict ids, global RadixWord* nodes,
                  volatile global Arrivals* ends, const uint leaves)
{
    const Chunk chunk = own_chunk(leaves);
    for (uint leaf = chunk.first; leaf < chunk.end; ++leaf) {
        const Reached at = {leaf, leaf, common_of(codes, leaves, leaf, leaf - 1u),
                            common_of(codes, leaves, leaf, leaf + 1u),
                            leaf_box(leaf_boxes, ids, leaf)};
        climb(codes, leaf_boxes, ids, nodes, ends, leaves, at);
    }
}

#else

/// Local memory of a group whose first leaf is `begin`.
typedef struct {
    /// Boxes of nodes: of left children at the place of their last leaf, of right ones at that of their first.
    BoxWord boxes[WORDS_PER_BOX * GROUP_SIZE];
    uint common[GROUP_SIZE + 1u];    ///< common_of leaves begin - 1 + k and begin + k
    GroupArrivals ends[GROUP_SIZE];  ///< as the global ones, of the gaps after the group's leaves
} Group;

/// Climbs while the parent has a longer prefix than `outside`, and so no leaf outside the group. False if a sibling has not
/// arrived yet.
///
/// A box is overwritten only by that of an ancestor. By then it was read: whoever joined the two children read it first.
static inline bool climbed(local Group* group, global RadixWord* nodes, const uint begin,
                           const uint outside, Reached* at)
{
    while (max(at->before, at->after) > outside) {
        const bool left = is_left(*at);
        const uint split = split_above(*at);
        store_local_box(group->boxes, (left ? split : split + 1u) - begin, at->box);
        const uint end = exchanged_in_group(&group->ends[split - begin], own_end(*at));
        if (end == 0u)
            return false;
        if (left)
            at->last = end - 1u;
        else
            at->first = end - 1u;
        at->before = group->common[at->first - begin];
        at->after = group->common[at->last + 1u - begin];
        at->box =
            merged(at->box, load_local_box(group->boxes, (left ? split + 1u : split) - begin));
        store_reached(nodes, *at, split);
    }
    return true;
}

/// As above, with one work-item per leaf.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void build(
    global const Code* restrict codes, global const BoxWord* restrict leaf_boxes,
    global const uint* restrict ids, global RadixWord* nodes, volatile global Arrivals* ends,
    const uint leaves)
{
    local Group group;
    const uint item = (uint)get_local_id(0), leaf = (uint)get_global_id(0), begin = leaf - item;
    await_in_group(&group.ends[item]);
    group.common[item + 1u] = common_of(codes, leaves, leaf, leaf + 1u);
    if (item == 0u)
        group.common[0] = common_of(codes, leaves, begin, begin - 1u);
    barrier(CLK_LOCAL_MEM_FENCE);
    if (leaf >= leaves)
        return;
    const uint outside = max(common_of(codes, leaves, leaf, begin - 1u),
                             common_of(codes, leaves, leaf, begin + GROUP_SIZE));
    Reached at = {leaf, leaf, group.common[item], group.common[item + 1u],
                  leaf_box(leaf_boxes, ids, leaf)};
    if (climbed(&group, nodes, begin, outside, &at))
        climb(codes, leaf_boxes, ids, nodes, ends, leaves, at);
}

#endif
