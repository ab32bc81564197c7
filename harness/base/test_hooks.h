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

/// Variables of the environment that are set and change what is measured, with their values. Throws BadUsage for a value
/// that cannot be read.
std::map<std::string, std::string> test_hooks();

/// Makes the stages of the builder or collider called `name` take as many times as long as BVHBENCH_SLOW says:
/// "oibvh-multi:1.10", or several of these with commas between. Throws BadUsage if it says something else.
void slow_down(std::span<StageTime> stages, std::string_view name);

}  // namespace bvhbench
