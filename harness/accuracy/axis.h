// SPDX-License-Identifier: MIT
//
// Axes of accuracy. An axis has one question, answered by several methods over several inputs; it measures each method's run
// time and its number of errors against an exact reference. docs/accuracy.md describes the references.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/base/terminal.h"
#include "harness/measure/engine.h"
#include "harness/measure/run.h"
#include "harness/record/record.h"
#include "harness/session/session.h"

namespace bvhbench {

/// Options of an axis.
struct AxisTask {
    std::vector<std::string> scenes;  ///< empty: the axis's own scenes
    std::size_t pairs = 1'000'000;    ///< in total, for axes about pairs
    /// Pairs of a class that are in memory at a time.
    std::size_t pairs_at_once = 1u << 20;
    uint seed = 1;  ///< seed of the first piece of pairs; later pieces use the numbers after it
    int samples = 5;
    CellFilter filter;  ///< on "input/method"

    bool wants(std::string_view input, std::string_view method) const;
};

/// Context of an axis: where it runs and where its cells go. There is one cell for each input and method, in the tables' order.
struct AxisRun {
    Session& session;
    const AxisTask& task;
    int& order;  ///< number of the next sample
    Progress& progress;
    std::function<void(Cell&&)> add;

    /// Returns an engine that takes one warm-up sample first.
    Engine engine() const { return {session, {.samples = task.samples, .warm_up = 1}, order}; }
};

struct Axis {
    std::string_view name;      ///< the key on the command line and in result files
    std::string_view question;  ///< one line
    void (*measure_all)(const AxisRun& run) = nullptr;  ///< for an axis that is not about frames
    /// For an axis about frames: measures a scene's first frame on the device, as one object or, with `by_objects`, as the
    /// scene's objects. Called for each scene asked for, or for each of own_scenes.
    void (*measure_frame)(const AxisRun& run, const SceneFacts& scene,
                          const Input& input) = nullptr;
    std::span<const char* const> own_scenes = {};
    bool by_objects = false;

    /// Adds a cell for each input and method. Without a scene or reference it adds a cell of the method "all" with the reason.
    void measure(const AxisRun& run) const;
};

/// Returns every axis, in the order in which they run.
std::span<const Axis> accuracy_axes();

/// Returns the axis `name`. Throws BadUsage with the known names if there is none.
const Axis& find_axis(std::string_view name);

// Shared by the files of the axes.

/// Returns a cell that names the axis, the method and the input.
Cell accuracy_cell(std::string_view axis, std::string_view method, SceneFacts input);

/// A method that answers an axis's question over an input.
struct AxisMethod {
    std::string name;
    BuilderChoice builder = {.name = "none"};
    ColliderChoice collider = {};
    std::function<void(Subject&)> settle;  ///< as `work` of Engine::settle
};

/// Adds a cell for each method that the filter accepts: settled, sampled interleaved with the others, and judged.
void measure_methods(const AxisRun& run, std::string_view axis, const SceneFacts& input,
                     std::span<const AxisMethod> methods);

/// A method of the axis sums: a way to add up the surface area cost (SAH) of a tree.
struct SumMethod {
    std::string_view name;
    /// Returns the cost with the default node costs. The root must have an area.
    double (*cost)(const HostTree& tree);
    bool is_ours = false;  ///< the method that the counter sah_cost uses
};

/// Returns all methods, in the tables' order.
std::span<const SumMethod> sum_methods();

/// Returns the reference cost: areas and sums in long double (64-bit significand on x86).
long double cost_in_long_double(const HostTree& tree);

void measure_narrow(const AxisRun& run);
void measure_swept(const AxisRun& run);
void measure_sums(const AxisRun& run, const SceneFacts& scene, const Input& input);
void measure_codes(const AxisRun& run, const SceneFacts& scene, const Input& input);
void measure_input(const AxisRun& run, const SceneFacts& scene, const Input& input);
void measure_boxes(const AxisRun& run, const SceneFacts& scene, const Input& input);

}  // namespace bvhbench
