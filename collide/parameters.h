// SPDX-License-Identifier: MIT
//
// Tuning parameters of colliders and of the narrow phase (device/tuning.h); builders/parameters.h has the others.
#pragma once

#include "device/tuning.h"

namespace bvhbench {

/// Smallest work-group size: one work-item per counter that an iteration flushes, and one per child of the widest node.
inline constexpr uint smallest_group = 8;

/// A parameter that is a work-group size.
constexpr Parameter group_size_parameter(std::string_view name, std::string_view meaning,
                                         std::string_view stage, uint usual)
{
    return usually(usual, name, stage, meaning, {smallest_group, 256, true}, {32, 64, 128, 256});
}

inline constexpr Parameter leaf_group_size = [] {
    Parameter chosen =
        group_size_parameter("leaf.group_size", "work-items in a group of leaf", "broad", 64);
    chosen.elsewhere = 256;
    return chosen;
}();
inline constexpr Parameter group_group_size = group_size_parameter(
    "group.group_size", "work-items in a group of group, and leaves a query of it", "broad", 64);
inline constexpr Parameter walk_task_leaves = usually(
    64, "walk.task_leaves", "broad", "leaves a query of leaf and group in the form for few cores",
    {1, 256}, {8, 16, 32, 64, 128, 256});
inline constexpr Parameter group_loose =
    usually(2, "group.loose", "broad",
            "the common box of leaves is not used if its area exceeds that of the leaves "
            "together this many times",
            {1, 64}, {1, 2, 3, 4, 8});
inline constexpr Parameter group_frontier_per_item =
    usually(6, "group.frontier_per_item", "broad",
            "nodes a work-item that a group's frontier has room for", {1, 32}, {2, 4, 6, 8, 12});
inline constexpr Parameter block_teams = usually(
    4, "block.teams", "broad", "blocks of leaves a group of block, a warp each, on NVIDIA's GPUs",
    {1, 8}, {1, 2, 4, 8});
inline constexpr Parameter bvtt_group_size =
    group_size_parameter("bvtt.group_size", "work-items in a group of bvtt", "broad", 128);
inline constexpr Parameter bvtt_items = usually(
    4, "bvtt.items", "broad", "tasks a work-item of bvtt has a turn", {1, 16}, {1, 2, 4, 8});
inline constexpr Parameter bvtt_jump =
    usually(1, "bvtt.jump", "broad",
            "levels a step of bvtt descends in a binary tree without pointers, if not asked for",
            {1, 5}, {1, 2, 3, 4});
inline constexpr Parameter bvtt_start_level =
    usually(0, "bvtt.start_level", "broad",
            "the level bvtt starts on in such a tree, if not asked for; 0: the root", {0, 12},
            {0, 2, 4, 5, 6, 7, 8});
inline constexpr Parameter front_group_size =
    group_size_parameter("front.group_size", "work-items in a group of front", "broad", 128);
inline constexpr Parameter front_items = usually(
    4, "front.items", "broad", "tasks a work-item of front has a turn", {1, 16}, {1, 2, 4, 8});
inline constexpr Parameter leaf_front_group_size = group_size_parameter(
    "front-leaf.group_size", "work-items in a group of front-leaf", "broad", 128);
inline constexpr Parameter leaf_front_ordered =
    usually(1, "front-leaf.ordered", "broad",
            "1: front-leaf orders its entries by node when it writes them; 0: not", {0, 1}, {0, 1});
inline constexpr Parameter grid_group_size = group_size_parameter(
    "grid.group_size", "work-items in a group that compares the entries of a cell", "broad", 64);
inline constexpr Parameter all_pairs_group_size = group_size_parameter(
    "all-pairs.group_size", "work-items in a group that has a tile of boxes", "broad", 128);
inline constexpr Parameter all_pairs_rows = usually(
    1, "all-pairs.rows", "broad",
    "boxes of a tile that a work-item tests against those in local memory", {1, 4}, {1, 2, 4});
inline constexpr Parameter sort_sweep_group_size = group_size_parameter(
    "sort-sweep.group_size", "work-items in a group of sort-sweep", "broad", 128);
inline constexpr Parameter narrow_group_size = group_size_parameter(
    "narrow.group_size", "work-items in a group of the narrow phase", "narrow", 128);

/// All parameters of this file.
inline constexpr const Parameter* collider_parameters[] = {
    &leaf_group_size,
    &group_group_size,
    &walk_task_leaves,
    &group_loose,
    &group_frontier_per_item,
    &block_teams,
    &bvtt_group_size,
    &bvtt_items,
    &bvtt_jump,
    &bvtt_start_level,
    &front_group_size,
    &front_items,
    &leaf_front_group_size,
    &leaf_front_ordered,
    &grid_group_size,
    &all_pairs_group_size,
    &all_pairs_rows,
    &sort_sweep_group_size,
    &narrow_group_size,
};

}  // namespace bvhbench
