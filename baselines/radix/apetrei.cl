// SPDX-License-Identifier: MIT
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=0
// check: -DCODE_WORDS=2 -DSORTED_LEAVES=1
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=4u
//
// [Apetrei2014] as printed: a node's index is its split. Its children and the two ends of its range are stored in arrays; each
// child writes its half. A counter per node makes the second child to arrive continue.
//
//     leaves    first ... split | split+1 ... last      node `split`: children[split], ranges[split]
#include "baselines/radix/leaves.clh"
#include "device/handoff.clh"

/// Writes radix_common of leaves k and k + 1 to common[k]. It is largest for the nearest neighbours, while delta of
/// [Apetrei2014] is smallest for them.
kernel void deltas(global const Code* restrict codes, global uint* restrict common,
                   const uint leaves)
{
    const Chunk chunk = own_chunk(leaves - 1u);
    for (uint k = chunk.first; k < chunk.end; ++k)
        common[k] = common_of(codes, leaves, k, k + 1u);
}

/// Buffers of a build.
typedef struct {
    global const uint* common;
    global const BoxWord* leaf_boxes;
    global const uint* ids;
    global uint* children;  ///< left and right child of node k at 2k and 2k + 1
    global uint* ranges;    ///< first and last leaf of node k at 2k and 2k + 1
    global BoxWord* boxes;
} Tree;

static inline Aabb box_of_child(const Tree tree, const uint child)
{
    return radix_is_leaf(child) ? leaf_box(tree.leaf_boxes, tree.ids, radix_index(child))
                                : load_box(tree.boxes, child);
}

/// Returns the parent of `child`, the split towards its nearer neighbour, and stores the child and its end of the range there
/// (Algorithm 1 of the paper).
static inline uint choose_parent(const Tree tree, const uint leaves, const uint child,
                                 const uint first, const uint last)
{
    const bool is_left =
        first == 0u || (last != leaves - 1u && tree.common[last] > tree.common[first - 1u]);
    const uint parent = is_left ? last : first - 1u;
    const ulong place = 2ul * parent + (is_left ? 0ul : 1ul);
    tree.children[place] = child;
    tree.ranges[place] = is_left ? first : last;
    return parent;
}

static inline void climb_from(const Tree tree, volatile global Arrivals* arrivals,
                              global uint* root, const uint leaves, const uint leaf)
{
    uint first = leaf, last = leaf, child = radix_child(leaf, true);
    while (first != 0u || last != leaves - 1u) {
        const uint node = choose_parent(tree, leaves, child, first, last);
        if (!arrived_second(&arrivals[node]))
            return;
        forget_arrivals(&arrivals[node]);
        first = tree.ranges[2ul * node];
        last = tree.ranges[2ul * node + 1ul];
        const Aabb left = box_of_child(tree, tree.children[2ul * node]);
        const Aabb right = box_of_child(tree, tree.children[2ul * node + 1ul]);
        store_box(tree.boxes, node, merged(left, right));
        child = node;
    }
    *root = child;
}

/// Builds the radix tree of `common` into `children`, `ranges` and `boxes`, and writes the root's index to `root`. `arrivals`
/// has one entry per inner node, zero before and after.
kernel void build(global const uint* restrict common, global const BoxWord* restrict leaf_boxes,
                  global const uint* restrict ids, global uint* children, global uint* ranges,
                  global BoxWord* boxes, volatile global Arrivals* arrivals, global uint* root,
                  const uint leaves)
{
    const Tree tree = {common, leaf_boxes, ids, children, ranges, boxes};
    const Chunk chunk = own_chunk(leaves);
    for (uint leaf = chunk.first; leaf < chunk.end; ++leaf)
        climb_from(tree, arrivals, root, leaves, leaf);
}
