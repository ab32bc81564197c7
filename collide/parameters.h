// SPDX-License-Identifier: MIT
//
// What colliders and the narrow phase let a device choose (device/tuning.h), beside builders/parameters.h.
#pragma once

#include "device/tuning.h"

namespace bvhbench {

/// Work-items that a group has at the least: one each for what is counted at the end of a turn, and for the children of
/// the widest node.
inline constexpr uint smallest_group = 8;

inline constexpr Parameter leaf_group_size{.name = "leaf.group_size",
                                           .meaning = "work-items in a group of leaf",
                                           .stage = "broad",
                                           .on_cpu = 64,
                                           .elsewhere = 256,
                                           .least = smallest_group,
                                           .most = 256,
                                           .values = ValueIs::group_size,
                                           .candidates = {32, 64, 128, 256}};
inline constexpr Parameter group_group_size{
    .name = "group.group_size",
    .meaning = "work-items in a group of group, and leaves a query of it",
    .stage = "broad",
    .on_cpu = 64,
    .elsewhere = 64,
    .least = smallest_group,
    .most = 256,
    .values = ValueIs::group_size,
    .candidates = {32, 64, 128, 256}};
inline constexpr Parameter walk_task_leaves{
    .name = "walk.task_leaves",
    .meaning = "leaves a query of leaf and group in the form for few cores",
    .stage = "broad",
    .on_cpu = 64,
    .elsewhere = 64,
    .least = 1,
    .most = 256,
    .candidates = {8, 16, 32, 64, 128, 256}};
inline constexpr Parameter walk_block_pairs{
    .name = "walk.block_pairs",
    .meaning =
        "pairs that a work-item of those collects before it passes them on, in that form; 512 are "
        "half of its fastest cache",
    .stage = "broad",
    .on_cpu = 512,
    .elsewhere = 512,
    .least = 16,
    .most = 65536,
    .candidates = {128, 256, 512, 1024, 2048}};

inline constexpr Parameter group_loose{.name = "group.loose",
                                       .meaning =
                                           "the common box of leaves is not used if its area "
                                           "exceeds that of the leaves together this many times",
                                       .stage = "broad",
                                       .on_cpu = 2,
                                       .elsewhere = 2,
                                       .least = 1,
                                       .most = 64,
                                       .candidates = {1, 2, 3, 4, 8}};
inline constexpr Parameter group_frontier_per_item{
    .name = "group.frontier_per_item",
    .meaning = "nodes a work-item that a group's frontier has room for",
    .stage = "broad",
    .on_cpu = 6,
    .elsewhere = 6,
    .least = 1,
    .most = 32,
    .candidates = {2, 4, 6, 8, 12}};

inline constexpr Parameter block_teams{
    .name = "block.teams",
    .meaning = "blocks of leaves a group of block, a warp each, on NVIDIA's GPUs",
    .stage = "broad",
    .on_cpu = 4,
    .elsewhere = 4,
    .least = 1,
    .most = 8,
    .candidates = {1, 2, 4, 8}};
inline constexpr Parameter block_loose{
    .name = "block.loose",
    .meaning = "as group.loose, of block; on an H200 2 takes 3 to 9 % longer over hilbert30",
    .stage = "broad",
    .on_cpu = 4,
    .elsewhere = 4,
    .least = 1,
    .most = 64,
    .candidates = {1, 2, 4, 8}};

inline constexpr Parameter bvtt_group_size{.name = "bvtt.group_size",
                                           .meaning = "work-items in a group of bvtt and front",
                                           .stage = "broad",
                                           .on_cpu = 128,
                                           .elsewhere = 128,
                                           .least = smallest_group,
                                           .most = 256,
                                           .values = ValueIs::group_size,
                                           .candidates = {32, 64, 128, 256}};
inline constexpr Parameter bvtt_items{.name = "bvtt.items",
                                      .meaning = "tasks a work-item of bvtt and front has a turn",
                                      .stage = "broad",
                                      .on_cpu = 4,
                                      .elsewhere = 4,
                                      .least = 1,
                                      .most = 16,
                                      .candidates = {1, 2, 4, 8}};
inline constexpr Parameter bvtt_groups_per_unit{
    .name = "bvtt.groups_per_unit",
    .meaning = "groups of bvtt and front a compute unit, at most",
    .stage = "broad",
    .on_cpu = 16,
    .elsewhere = 16,
    .least = 1,
    .most = 256,
    .candidates = {4, 8, 16, 32, 64}};
inline constexpr Parameter bvtt_block_pairs{
    .name = "bvtt.block_pairs",
    .meaning = "entries a list that a work-item of bvtt or front collects, on few cores",
    .stage = "broad",
    .on_cpu = 256,
    .elsewhere = 256,
    .least = 16,
    .most = 65536,
    .candidates = {64, 128, 256, 512, 1024}};
inline constexpr Parameter bvtt_jump{
    .name = "bvtt.jump",
    .meaning = "levels a step of bvtt descends in a binary tree without pointers, if not asked for",
    .stage = "broad",
    .on_cpu = 1,
    .elsewhere = 1,
    .least = 1,
    .most = 5,
    .candidates = {1, 2, 3, 4}};
inline constexpr Parameter bvtt_start_level{
    .name = "bvtt.start_level",
    .meaning = "the level bvtt starts on in such a tree, if not asked for; 0: the root",
    .stage = "broad",
    .on_cpu = 0,
    .elsewhere = 0,
    .least = 0,
    .most = 12,
    .candidates = {0, 2, 4, 5, 6, 7, 8}};

inline constexpr Parameter grid_group_size{
    .name = "grid.group_size",
    .meaning = "work-items in a group that holds entries of a cell to each other",
    .stage = "broad",
    .on_cpu = 64,
    .elsewhere = 64,
    .least = smallest_group,
    .most = 256,
    .values = ValueIs::group_size,
    .candidates = {32, 64, 128, 256}};
inline constexpr Parameter grid_block_pairs{
    .name = "grid.block_pairs",
    .meaning = "pairs that a work-item collects before it passes them on, on few cores",
    .stage = "broad",
    .on_cpu = 512,
    .elsewhere = 512,
    .least = 16,
    .most = 65536,
    .candidates = {128, 256, 512, 1024, 2048}};
inline constexpr Parameter grid_buckets_each{
    .name = "grid.buckets_each",
    .meaning = "buckets a triangle, before rounding up to a power of two",
    .stage = "",
    .on_cpu = 1,
    .elsewhere = 1,
    .least = 1,
    .most = 8,
    .values = ValueIs::power_of_two,
    .candidates = {1, 2, 4}};

inline constexpr Parameter narrow_group_size{.name = "narrow.group_size",
                                             .meaning = "work-items in a group of the narrow phase",
                                             .stage = "narrow",
                                             .on_cpu = 128,
                                             .elsewhere = 128,
                                             .least = smallest_group,
                                             .most = 256,
                                             .values = ValueIs::group_size,
                                             .candidates = {32, 64, 128, 256}};
inline constexpr Parameter narrow_groups_per_unit{
    .name = "narrow.groups_per_unit",
    .meaning = "groups of the narrow phase a compute unit, at most",
    .stage = "narrow",
    .on_cpu = 32,
    .elsewhere = 32,
    .least = 1,
    .most = 256,
    .candidates = {8, 16, 32, 64}};
inline constexpr Parameter narrow_block_pairs{
    .name = "narrow.block_pairs",
    .meaning = "pairs of a kind that a work-item of it collects, on few cores",
    .stage = "narrow",
    .on_cpu = 512,
    .elsewhere = 512,
    .least = 16,
    .most = 65536,
    .candidates = {128, 256, 512, 1024, 2048}};

/// All of them.
inline constexpr const Parameter* collider_parameters[] = {
    &leaf_group_size,
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
    &narrow_block_pairs,
};

}  // namespace bvhbench
