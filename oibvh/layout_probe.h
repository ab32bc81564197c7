// SPDX-License-Identifier: MIT
//
// All queries about a node of either layout, answered in one struct: the probe kernel computes it on the device, a test on the
// host.
#ifndef BVHBENCH_OIBVH_LAYOUT_PROBE_H
#define BVHBENCH_OIBVH_LAYOUT_PROBE_H

#include "oibvh/kary_layout.h"
#include "oibvh/layout.h"

SHARED_BEGIN

/// A node of a tree. `node` may be real or virtual.
typedef struct {
    uint leaves;
    uint arity;
    uint node;
} LayoutQuestion;

/// 18 words, so that answers of host and device can be compared bit for bit.
typedef struct {
    uint leaf_level, virtual_leaves, node_count, virtual_node_count, perfect_node_count;
    uint level, is_real, first, real_on, virtual_on, first_slot;
    uint slot;  ///< 0 if the node is virtual.
    uint is_full;
    uint left, right, parent;  ///< Children: 0 at leaves. Parent: 0 at the root.
    uint half_way_up,
        leftmost_leaf;  ///< Eq. (13) for half of the levels; Eq. (12) down to the leaf level.
} LayoutAnswers;

/// Answers for layout.h; ignores `question.arity`.
SHARED_FN LayoutAnswers oi_answers(LayoutQuestion question)
{
    const OiShape shape = oi_shape(question.leaves);
    const uint i = question.node;
    const uint level = oi_level(i);
    LayoutAnswers answers;
    answers.leaf_level = shape.leaf_level;
    answers.virtual_leaves = shape.virtual_leaves;
    answers.node_count = oi_node_count(shape);
    answers.virtual_node_count = oi_virtual_node_count(shape);
    answers.perfect_node_count = oi_perfect_node_count(shape);
    answers.level = level;
    answers.is_real = oi_is_real(shape, i) ? 1u : 0u;
    answers.first = oi_first(level);
    answers.real_on = oi_real_on(shape, level);
    answers.virtual_on = oi_virtual_on(shape, level);
    answers.first_slot = oi_first_slot(shape, level);
    answers.slot = oi_is_real(shape, i) ? oi_slot(shape, i) : 0u;
    answers.is_full = oi_is_full(shape, level) ? 1u : 0u;
    answers.left = level < shape.leaf_level ? oi_left(i) : 0u;
    answers.right = level < shape.leaf_level ? oi_right(i) : 0u;
    answers.parent = i > 0u ? oi_parent(i) : 0u;
    answers.half_way_up = oi_ancestor(i, level / 2u);
    answers.leftmost_leaf = oi_descendant(i, shape.leaf_level - level, 0u);
    return answers;
}

/// Answers for kary_layout.h; `left` and `right` are the first and the last child.
SHARED_FN LayoutAnswers kary_answers(LayoutQuestion question)
{
    const uint arity = question.arity;
    const KaryShape shape = kary_shape(question.leaves, arity);
    const uint i = question.node;
    const uint level = kary_level(shape, i);
    LayoutAnswers answers;
    answers.leaf_level = shape.leaf_level;
    answers.virtual_leaves = shape.virtual_leaves;
    answers.node_count = kary_node_count(shape);
    answers.virtual_node_count = kary_virtual_node_count(shape);
    answers.perfect_node_count = kary_perfect_node_count(shape);
    answers.level = level;
    answers.is_real = kary_is_real(shape, i) ? 1u : 0u;
    answers.first = kary_first(arity, level);
    answers.real_on = kary_real_on(shape, level);
    answers.virtual_on = kary_virtual_on(shape, level);
    answers.first_slot = kary_first_slot(shape, level);
    answers.slot = kary_is_real(shape, i) ? kary_slot(shape, i) : 0u;
    answers.is_full = kary_virtual_on(shape, level) == 0u ? 1u : 0u;
    answers.left = level < shape.leaf_level ? kary_child(arity, i, 1u) : 0u;
    answers.right = level < shape.leaf_level ? kary_child(arity, i, arity) : 0u;
    answers.parent = i > 0u ? kary_parent(arity, i) : 0u;
    answers.half_way_up = kary_ancestor(arity, i, level / 2u);
    answers.leftmost_leaf = kary_descendant(arity, i, shape.leaf_level - level, 0u);
    return answers;
}

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(bvhbench::LayoutQuestion) == 12);
static_assert(sizeof(bvhbench::LayoutAnswers) == 72);
#endif
#endif
