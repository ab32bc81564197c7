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
    .candidates = {32, 64, 128, 256, 512}};

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

inline constexpr const Parameter* baseline_parameters[] = {&radix_group_size, &hploc_group_size};

}  // namespace bvhbench
