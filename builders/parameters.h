// SPDX-License-Identifier: MIT
//
// What builders let a device choose (device/tuning.h), in the order `bvhbench list tuning` shows it. To add a
// parameter, declare it here, put it into the list at the end, and ask the device for it where its value was.
#pragma once

#include <span>

#include "device/tuning.h"

namespace bvhbench {

/// Of everything in the form for few cores, colliders' kernels too.
inline constexpr Parameter chunks_per_core{.name = "chunks.per_core",
                                           .meaning =
                                               "work-items a core, each with a long run: more, and "
                                               "none waits long for one that was interrupted",
                                           .stage = "",
                                           .on_cpu = 4,
                                           .elsewhere = 4,
                                           .least = 1,
                                           .most = 256,
                                           .candidates = {1, 2, 4, 8, 16}};

inline constexpr Parameter bounds_group_size{.name = "bounds.group_size",
                                             .meaning = "work-items in a group of the stage bounds",
                                             .stage = "bounds",
                                             .on_cpu = 256,
                                             .elsewhere = 256,
                                             .least = 16,
                                             .most = 1024,
                                             .values = ValueIs::group_size,
                                             .candidates = {64, 128, 256, 512}};
inline constexpr Parameter bounds_groups_per_unit{
    .name = "bounds.groups_per_unit",
    .meaning = "groups a compute unit, each of which leaves bounds to be joined",
    .stage = "bounds",
    .on_cpu = 8,
    .elsewhere = 8,
    .least = 1,
    .most = 64,
    .candidates = {2, 4, 8, 16, 32}};

inline constexpr Parameter codes_group_size{.name = "codes.group_size",
                                            .meaning = "work-items in a group of the stage codes",
                                            .stage = "codes",
                                            .on_cpu = 256,
                                            .elsewhere = 256,
                                            .least = 1,
                                            .most = 1024,
                                            .values = ValueIs::group_size,
                                            .candidates = {64, 128, 256, 512, 1024}};

inline constexpr Parameter sort_chunk_digit_bits{
    .name = "sort.chunk_digit_bits",
    .meaning = "bits a pass sorts by, in the form for few cores",
    .stage = "sort",
    .on_cpu = 8,
    .elsewhere = 8,
    .least = 1,
    .most = 12,
    .candidates = {6, 7, 8, 9, 10, 11}};
inline constexpr Parameter sort_group_size{
    .name = "sort.group_size",
    .meaning = "work-items in a group, where groups do not wait for each other",
    .stage = "sort",
    .on_cpu = 256,
    .elsewhere = 256,
    .least = 16,
    .most = 256,
    .values = ValueIs::group_size,
    .candidates = {64, 128, 256}};
inline constexpr Parameter sort_keys_per_item{
    .name = "sort.keys_per_item",
    .meaning = "pairs a work-item ranks where groups do not wait; odd, against bank conflicts",
    .stage = "sort",
    .on_cpu = 15,
    .elsewhere = 15,
    .least = 1,
    .most = 15,
    .values = ValueIs::odd,
    .candidates = {7, 9, 11, 13, 15}};
inline constexpr Parameter sweep_group_size{
    .name = "sweep.group_size",
    .meaning = "work-items in a group of the sort, where groups wait for each other",
    .stage = "sort",
    .on_cpu = 512,
    .elsewhere = 512,
    .least = 32,
    .most = 512,
    .values = ValueIs::group_size,
    .candidates = {128, 256, 512}};
inline constexpr Parameter sweep_keys_per_item{
    .name = "sweep.keys_per_item",
    .meaning = "pairs a work-item ranks where groups wait; of codes of two words half as many",
    .stage = "sort",
    .on_cpu = 8,
    .elsewhere = 8,
    .least = 1,
    .most = 32,
    .candidates = {4, 6, 8, 10, 12, 16}};
inline constexpr Parameter sweep_counting_groups_per_unit{
    .name = "sweep.counting_groups_per_unit",
    .meaning = "groups a compute unit that count digits, where groups wait",
    .stage = "sort",
    .on_cpu = 2,
    .elsewhere = 2,
    .least = 1,
    .most = 32,
    .candidates = {1, 2, 4, 8}};

inline constexpr Parameter sort_at_once{
    .name = "sort.at_once",
    .meaning = "where groups wait, 1: few pairs are sorted in one launch; 0: in one launch a pass",
    .stage = "sort",
    .on_cpu = 0,
    .elsewhere = 1,
    .least = 0,
    .most = 1,
    .candidates = {0, 1}};

inline constexpr Parameter medians_group_size{
    .name = "medians.group_size",
    .meaning = "work-items in a group that orders a block of leaves",
    .stage = "order",
    .on_cpu = 256,
    .elsewhere = 256,
    .least = 32,
    .most = 1024,
    .values = ValueIs::group_size,
    .candidates = {128, 256, 512, 1024}};
inline constexpr Parameter cells_pass_group_size{
    .name = "cells.pass_group_size",
    .meaning = "work-items in a group of a pass that counts in global memory",
    .stage = "order",
    .on_cpu = 128,
    .elsewhere = 128,
    .least = 32,
    .most = 1024,
    .values = ValueIs::group_size,
    .candidates = {64, 128, 256, 512}};
inline constexpr Parameter cells_pass_leaves{
    .name = "cells.pass_leaves",
    .meaning = "leaves that a work-item of such a pass looks at",
    .stage = "order",
    .on_cpu = 3,
    .elsewhere = 3,
    .least = 1,
    .most = 16,
    .candidates = {1, 2, 3, 4, 6, 8}};
inline constexpr Parameter cells_local_leaves{
    .name = "cells.local_leaves",
    .meaning = "the same at a time, of a pass that counts in local memory",
    .stage = "order",
    .on_cpu = 4,
    .elsewhere = 4,
    .least = 1,
    .most = 16,
    .candidates = {1, 2, 4, 8}};
inline constexpr Parameter cells_chunk_levels{
    .name = "cells.chunk_levels",
    .meaning = "levels halved one by one before each core takes subtrees",
    .stage = "order",
    .on_cpu = 3,
    .elsewhere = 3,
    .least = 0,
    .most = 8,
    .candidates = {1, 2, 3, 4, 5, 6}};

inline constexpr Parameter gather_group_size{.name = "gather.group_size",
                                             .meaning = "work-items in a group of the stage gather",
                                             .stage = "gather",
                                             .on_cpu = 256,
                                             .elsewhere = 256,
                                             .least = 16,
                                             .most = 1024,
                                             .values = ValueIs::group_size,
                                             .candidates = {64, 128, 256, 512}};

inline constexpr Parameter implicit_group_size{
    .name = "implicit.group_size",
    .meaning =
        "work-items in a group that builds a subtree, twice as many nodes' levels a launch; 0: the "
        "fewest "
        "that get by with the fewest launches",
    .stage = "hierarchy",
    .on_cpu = 0,
    .elsewhere = 0,
    .least = 0,
    .most = 1024,
    .values = ValueIs::group_size,
    .candidates = {128, 256, 512, 1024}};
inline constexpr Parameter implicit_handoff_group_size{
    .name = "implicit.handoff_group_size",
    .meaning = "the same where one launch builds all levels; 0: by the number of leaves",
    .stage = "hierarchy",
    .on_cpu = 0,
    .elsewhere = 0,
    .least = 0,
    .most = 1024,
    .values = ValueIs::group_size,
    .candidates = {128, 256, 512, 1024}};
inline constexpr Parameter implicit_waits{.name = "implicit.waits",
                                          .meaning =
                                              "where one launch builds all levels, 1: a few groups "
                                              "wait for the roots of subtrees, if groups "
                                              "can wait; 0: the last group to arrive goes on",
                                          .stage = "hierarchy",
                                          .on_cpu = 0,
                                          .elsewhere = 1,
                                          .least = 0,
                                          .most = 1,
                                          .candidates = {0, 1}};
inline constexpr Parameter implicit_items{
    .name = "implicit.items",
    .meaning = "nodes of the entry level that a work-item merges in registers",
    .stage = "hierarchy",
    .on_cpu = 1,
    .elsewhere = 1,
    .least = 1,
    .most = 8,
    .values = ValueIs::power_of_two,
    .candidates = {1, 2, 4}};
inline constexpr Parameter implicit_subtrees_per_core{
    .name = "implicit.subtrees_per_core",
    .meaning = "subtrees a core that the first launch cuts a tree into, in the form for few cores",
    .stage = "hierarchy",
    .on_cpu = 32,
    .elsewhere = 32,
    .least = 1,
    .most = 1024,
    .values = ValueIs::power_of_two,
    .candidates = {2, 4, 8, 16, 32, 64}};

/// All of them.
inline constexpr const Parameter* builder_parameters[] = {
    &chunks_per_core,
    &bounds_group_size,
    &bounds_groups_per_unit,
    &codes_group_size,
    &sort_chunk_digit_bits,
    &sort_group_size,
    &sort_keys_per_item,
    &sweep_group_size,
    &sweep_keys_per_item,
    &sweep_counting_groups_per_unit,
    &sort_at_once,
    &medians_group_size,
    &cells_pass_group_size,
    &cells_pass_leaves,
    &cells_local_leaves,
    &cells_chunk_levels,
    &gather_group_size,
    &implicit_group_size,
    &implicit_handoff_group_size,
    &implicit_waits,
    &implicit_items,
    &implicit_subtrees_per_core,
};

}  // namespace bvhbench
