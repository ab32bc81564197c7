// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>

#include "harness/accuracy/axis.h"
#include "harness/measure/frames.h"
#include "harness/measure/pipeline.h"

namespace bvhbench {

/// Call `measure` for each scene asked for, or for those of the axis, with its first frame on the device: as one object,
/// or, `by_objects`, as those that the scene names. A scene for which that fails is a cell that says so, of the method "all".
void for_each_scene(const AxisRun& run, std::string_view axis,
                    std::initializer_list<const char*> own,
                    const std::function<void(const SceneFacts& facts, const Input& input)>& measure,
                    bool by_objects = false);

/// The first frame as one object's tree by a builder, spelled out.
HostTree built_tree(Session& session, const BuilderChoice& builder, const Input& input);

/// The surface area cost of trees over an input, one an object: the sum of their nodes' costs, of the sum of their roots'
/// areas. Nothing if no root has any.
std::optional<double> forest_cost(Session& session, const BuilderChoice& builder,
                                  const Input& input);

/// The pipeline of a cell's builder and collider, ready to be sampled over `input`. Its counters are then the cell's.
std::unique_ptr<Pipeline> settled_pipeline(Session& session, Cell& cell, const Input& input);

/// Hold the pairs that it found last to the right ones: the cell's verdict, and its counters of what is missed and false.
void judge_pairs(const Pipeline& pipeline, const PairList& right, const std::string& against,
                 Cell& cell);

}  // namespace bvhbench
