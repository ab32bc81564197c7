// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <initializer_list>
#include <string>

#include "harness/accuracy/axis.h"
#include "harness/frames.h"

namespace bvhbench {

/// Call `measure` for each scene asked for, or for those of the axis, with its first frame on the device. Throws what
/// loading a scene does.
void for_each_scene(const AxisRun& run, std::string_view axis,
                    std::initializer_list<const char*> own,
                    const std::function<void(const SceneFacts& facts, const Input& input)>& measure);

/// The first frame as one object's tree by a builder, spelled out.
HostTree built_tree(Session& session, const BuilderChoice& builder, const Input& input);

}  // namespace bvhbench
