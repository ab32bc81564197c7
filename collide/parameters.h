// SPDX-License-Identifier: MIT
//
// Tuning parameters of colliders and of the narrow phase (device/tuning.h); builders/parameters.h has the others.
#pragma once

#include "device/tuning.h"

namespace bvhbench {

/// Smallest work-group size: one work-item per counter that an iteration flushes, and one per child of the widest node.
inline constexpr uint smallest_group = 8;

constexpr Parameter number_parameter(std::string_view name, std::string_view meaning,
                                     std::string_view stage, uint usual, uint least, uint most,
                                     CandidateValues candidates,
                                     ValueIs values = ValueIs::any_number)
{
    return {name, meaning, stage, usual, usual, least, most, values, candidates};
}

/// A parameter that is a work-group size.
constexpr Parameter group_size_parameter(std::string_view name, std::string_view meaning,
                                         std::string_view stage, uint usual)
{
    return number_parameter(name, meaning, stage, usual, smallest_group, 256, {32, 64, 128, 256},
                            ValueIs::group_size);
}

/// A parameter that is the number of entries that a work-item of the chunk form buffers before it writes them out.
constexpr Parameter block_parameter(std::string_view name, std::string_view meaning,
                                    std::string_view stage, uint usual)
{
    return number_parameter(name, meaning, stage, usual, 16, 65536,
                            {usual / 4, usual / 2, usual, 2 * usual, 4 * usual});
}

inline constexpr Parameter leaf_group_size = [] {
    Parameter chosen =
        group_size_parameter("leaf.group_size", "work-items in a group of leaf", "broad", 64);
    chosen.elsewhere = 256;
    return chosen;
}();
inline constexpr Parameter group_group_size = group_size_parameter(
    "group.group_size", "work-items in a group of group, and leaves a query of it", "broad", 64);
inline constexpr Parameter walk_task_leaves = number_parameter(
    "walk.task_leaves", "leaves a query of leaf and group in the form for few cores", "broad", 64,
    1, 256, {8, 16, 32, 64, 128, 256});
inline constexpr Parameter walk_block_pairs =
    block_parameter("walk.block_pairs",
                    "pairs that a work-item of those collects before it passes them on, in that "
                    "form; 512 are half of its fastest cache",
                    "broad", 512);
inline constexpr Parameter group_loose =
    number_parameter("group.loose",
                     "the common box of leaves is not used if its area exceeds that of the leaves "
                     "together this many times",
                     "broad", 2, 1, 64, {1, 2, 3, 4, 8});
inline constexpr Parameter group_frontier_per_item = number_parameter(
    "group.frontier_per_item", "nodes a work-item that a group's frontier has room for", "broad", 6,
    1, 32, {2, 4, 6, 8, 12});
inline constexpr Parameter block_teams = number_parameter(
    "block.teams", "blocks of leaves a group of block, a warp each, on NVIDIA's GPUs", "broad", 4,
    1, 8, {1, 2, 4, 8});
inline constexpr Parameter block_loose = number_parameter(
    "block.loose", "as group.loose, of block; on an H200 2 takes 3 to 9 % longer over hilbert30",
    "broad", 4, 1, 64, {1, 2, 4, 8});
inline constexpr Parameter bvtt_group_size = group_size_parameter(
    "bvtt.group_size", "work-items in a group of bvtt and front", "broad", 128);
inline constexpr Parameter bvtt_items =
    number_parameter("bvtt.items", "tasks a work-item of bvtt and front has a turn", "broad", 4, 1,
                     16, {1, 2, 4, 8});
inline constexpr Parameter bvtt_groups_per_unit =
    number_parameter("bvtt.groups_per_unit", "groups of bvtt and front a compute unit, at most",
                     "broad", 16, 1, 256, {4, 8, 16, 32, 64});
inline constexpr Parameter bvtt_block_pairs = block_parameter(
    "bvtt.block_pairs", "entries a list that a work-item of bvtt or front collects, on few cores",
    "broad", 256);
inline constexpr Parameter bvtt_jump = number_parameter(
    "bvtt.jump",
    "levels a step of bvtt descends in a binary tree without pointers, if not asked for", "broad",
    1, 1, 5, {1, 2, 3, 4});
inline constexpr Parameter bvtt_start_level = number_parameter(
    "bvtt.start_level", "the level bvtt starts on in such a tree, if not asked for; 0: the root",
    "broad", 0, 0, 12, {0, 2, 4, 5, 6, 7, 8});
inline constexpr Parameter grid_group_size = group_size_parameter(
    "grid.group_size", "work-items in a group that holds entries of a cell to each other", "broad",
    64);
inline constexpr Parameter grid_block_pairs = block_parameter(
    "grid.block_pairs", "pairs that a work-item collects before it passes them on, on few cores",
    "broad", 512);
inline constexpr Parameter grid_buckets_each = number_parameter(
    "grid.buckets_each", "buckets a triangle, before rounding up to a power of two", "", 1, 1, 8,
    {1, 2, 4}, ValueIs::power_of_two);
inline constexpr Parameter narrow_group_size = group_size_parameter(
    "narrow.group_size", "work-items in a group of the narrow phase", "narrow", 128);
inline constexpr Parameter narrow_groups_per_unit =
    number_parameter("narrow.groups_per_unit", "groups of the narrow phase a compute unit, at most",
                     "narrow", 32, 1, 256, {8, 16, 32, 64});
inline constexpr Parameter narrow_block_pairs =
    block_parameter("narrow.block_pairs",
                    "pairs of a kind that a work-item of it collects, on few cores", "narrow", 512);

/// All parameters of this file.
inline constexpr const Parameter* collider_parameters[] = {&leaf_group_size,
                                                           &group_group_size,
                                                           &walk_task_leaves,
                                                           &walk_block_pairs,
                                                           &group_loose,
                                                           &group_frontier_per_item,
                                                           &block_teams,
                                                           &block_loose,
                                                           &bvtt_group_size,
                                                           &bvtt_items,
                                                           &bvtt_groups_per_unit,
                                                           &bvtt_block_pairs,
                                                           &bvtt_jump,
                                                           &bvtt_start_level,
                                                           &grid_group_size,
                                                           &grid_block_pairs,
                                                           &grid_buckets_each,
                                                           &narrow_group_size,
                                                           &narrow_groups_per_unit,
                                                           &narrow_block_pairs};

}  // namespace bvhbench
