// SPDX-License-Identifier: MIT
//
// Tuning parameters (device/tuning.h) of the baselines, in addition to builders/parameters.h.
#pragma once

#include "device/tuning.h"

namespace bvhbench {

inline constexpr Parameter radix_group_size{
    .name = "radix.group_size",
    .meaning = "work-items in a group of a radix tree's hierarchy",
    .stage = "hierarchy",
    .on_cpu = 256,
    .elsewhere = 256,
    .least = 1,
    .most = 1024,
    .is_group_size = true,
    .candidates = {32, 64, 128, 256, 512, 1024}};

inline constexpr Parameter radix_local{
    .name = "radix.local",
    .meaning =
        "apetrei-fused, 1: a group merges its own leaves in local memory first; 0: all "
        "nodes meet in global memory",
    .stage = "hierarchy",
    .on_cpu = 0,
    .elsewhere = 1,
    .least = 0,
    .most = 1,
    .candidates = {0, 1}};

inline constexpr Parameter levels_at_once{
    .name = "levels.at_once",
    .meaning = "lbvh-levels where groups wait, 1: all levels in one launch; 0: a launch a level",
    .stage = "hierarchy",
    .on_cpu = 0,
    .elsewhere = 1,
    .least = 0,
    .most = 1,
    .candidates = {0, 1}};

inline constexpr Parameter hploc_group_size{
    .name = "hploc.group_size",
    .meaning = "work-items in a group of the hierarchy of hploc, 32 of which work on a range",
    .stage = "hierarchy",
    .on_cpu = 32,
    .elsewhere = 64,
    .least = 32,
    .most = 512,
    .is_group_size = true,
    .candidates = {32, 64, 128, 256, 512}};

inline constexpr Parameter hploc_leaves{
    .name = "hploc.leaves",
    .meaning = "leaves whose ranges 32 work-items of hploc join in local memory",
    .stage = "hierarchy",
    .on_cpu = 128,
    .elsewhere = 128,
    .least = 32,
    .most = 256,
    .is_group_size = true,
    .candidates = {32, 64, 128, 256}};

inline constexpr const Parameter* baseline_parameters[] = {
    &radix_group_size, &radix_local, &levels_at_once, &hploc_group_size, &hploc_leaves};

}  // namespace bvhbench
