// SPDX-License-Identifier: MIT
//
// Tuning parameters of builders (device/tuning.h), in the order of `bvhbench list tuning`. To add one, declare it here, append
// it to the list at the end, and read it with Device::tuned where its value is used.
#pragma once

#include <span>

#include "device/tuning.h"

namespace bvhbench {

/// Used by all kernels in the form `chunks`, colliders' included.
inline constexpr Parameter chunks_per_core =
    usually(4, "chunks.per_core", "",
            "work-items a core, each with a long run: more, and none waits long for one that was "
            "interrupted",
            {1, 256}, {1, 2, 4, 8, 16});

inline constexpr Parameter bounds_group_size =
    usually(256, "bounds.group_size", "bounds", "work-items in a group of the stage bounds",
            {16, 1024, true}, {64, 128, 256, 512});

inline constexpr Parameter codes_group_size =
    usually(256, "codes.group_size", "codes", "work-items in a group of the stage codes",
            {1, 1024, true}, {64, 128, 256, 512, 1024});

inline constexpr Parameter sort_chunk_digit_bits =
    usually(10, "sort.chunk_digit_bits", "sort",
            "bits of the highest digit, in the form for few cores", {1, 12}, {6, 7, 8, 9, 10, 11});
inline constexpr Parameter sort_group_size =
    usually(256, "sort.group_size", "sort",
            "work-items in a group, where groups do not wait for each other", {16, 256, true},
            {64, 128, 256});

inline constexpr Parameter sweep_group_size =
    usually(512, "sweep.group_size", "sort",
            "work-items in a group of the sort, where groups wait for each other", {32, 512, true},
            {128, 256, 512});
inline constexpr Parameter sweep_keys_per_item =
    usually(8, "sweep.keys_per_item", "sort",
            "pairs a work-item ranks where groups wait; of codes of two words half as many",
            {1, 32}, {4, 6, 8, 10, 12, 16});

inline constexpr uint sort_at_once_with_boxes = 2;
inline constexpr Parameter sort_at_once{
    .name = "sort.at_once",
    .meaning =
        "where groups wait, 2: few leaves get boxes, codes and order in one launch; 1: few are "
        "sorted in one launch; 0: in one launch a pass",
    .stage = "",
    .on_cpu = 0,
    .elsewhere = sort_at_once_with_boxes,
    .least = 0,
    .most = sort_at_once_with_boxes,
    .candidates = {0, 1, 2}};

inline constexpr Parameter medians_group_size = usually(
    256, "medians.group_size", "order", "work-items in a group that orders a block of leaves",
    {32, 1024, true}, {128, 256, 512, 1024});

inline constexpr Parameter cells_pass_group_size =
    usually(128, "cells.pass_group_size", "order",
            "work-items in a group of a pass that counts in global memory", {32, 1024, true},
            {64, 128, 256, 512});

inline constexpr Parameter gather_group_size =
    usually(256, "gather.group_size", "gather", "work-items in a group of the stage gather",
            {16, 1024, true}, {64, 128, 256, 512});

inline constexpr Parameter implicit_group_size =
    usually(0, "implicit.group_size", "hierarchy",
            "work-items in a group that builds a subtree, twice as many nodes' levels a launch; 0: "
            "the fewest that get by with the fewest launches",
            {0, 1024, true}, {128, 256, 512, 1024});
inline constexpr Parameter implicit_handoff_group_size =
    usually(0, "implicit.handoff_group_size", "hierarchy",
            "the same where one launch builds all levels; 0: by the number of leaves",
            {0, 1024, true}, {128, 256, 512, 1024});
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

inline constexpr const Parameter* builder_parameters[] = {
    &chunks_per_core,
    &bounds_group_size,
    &codes_group_size,
    &sort_chunk_digit_bits,
    &sort_group_size,
    &sweep_group_size,
    &sweep_keys_per_item,
    &sort_at_once,
    &medians_group_size,
    &cells_pass_group_size,
    &gather_group_size,
    &implicit_group_size,
    &implicit_handoff_group_size,
    &implicit_waits,
};

}  // namespace bvhbench
