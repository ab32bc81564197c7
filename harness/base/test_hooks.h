// SPDX-License-Identifier: MIT
//
// What tests switch on to see whether a wrong number is found. A run that has any of them says so in its result file
// (`test_hooks`), which no figure is made of and no file is compared with unless asked to.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "device/queue.h"

namespace bvhbench {

/// Variables of the environment that are set and change what is measured, with their values.
std::map<std::string, std::string> test_hooks();

/// By what the times of the builder or collider called `name` are multiplied, as BVHBENCH_SLOW says: "oibvh-multi:1.10", or
/// several of these with commas between. 1 without. Throws BadUsage if it says something else.
double slowed_by(std::string_view name);

/// Make stages take `factor` times as long as they took.
void slow_down(std::span<StageTime> stages, double factor);

}  // namespace bvhbench
