// SPDX-License-Identifier: MIT
//
// Axes of accuracy: on each, the same question is answered by several methods over several inputs, with run time beside
// the number of errors against an exact reference. docs/accuracy.md says what the references are.
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

/// What an axis is given.
struct AxisTask {
    std::vector<std::string> scenes;  ///< empty: its own
    std::size_t pairs = 1'000'000;    ///< in all, of axes about pairs
    std::size_t pairs_at_once =
        1u << 20;   ///< what bounds the memory of a class, be it as large as it may
    uint seed = 1;  ///< of the first so many; of the next ones the numbers after it
    int samples = 5;
    CellFilter filter;  ///< on "input/method"

    bool wants(std::string_view input, std::string_view method) const;
};

/// Where it runs, and where its cells go: one an input and method, in the order of tables.
struct AxisRun {
    Session& session;
    const AxisTask& task;
    int& order;  ///< of samples
    Progress& progress;
    std::function<void(Cell&&)> add;

    /// Samples are taken after one to warm up.
    Engine engine() const { return {session, {.samples = task.samples, .warm_up = 1}, order}; }
};

struct Axis {
    std::string_view name;      ///< the key on the command line and in result files
    std::string_view question;  ///< one line
    void (*measure_all)(const AxisRun& run) = nullptr;  ///< of an axis that is not about frames
    /// Of one that is: over a scene's first frame on the device, as one object, or, `by_objects`, as those that the scene
    /// names. It is called for each scene asked for, or for the axis's own.
    void (*measure_frame)(const AxisRun& run, const SceneFacts& scene,
                          const Input& input) = nullptr;
    std::span<const char* const> own_scenes = {};
    bool by_objects = false;

    /// Cells that cannot be had, for want of a scene or a reference, say so; of a scene, by one of the method "all".
    void measure(const AxisRun& run) const;
};

/// Every axis, in the order in which they are run.
std::span<const Axis> accuracy_axes();

/// By name. Throws BadUsage with the known names when there is none.
const Axis& find_axis(std::string_view name);

// What the files of axes share.

/// A cell that says what is measured: on which axis, of what, by which method.
Cell accuracy_cell(std::string_view axis, std::string_view method, SceneFacts input);

/// A way to answer an axis's question over an input.
struct AxisMethod {
    std::string name;
    BuilderChoice builder = {.name = "none"};
    ColliderChoice collider = {};
    std::function<void(Subject&)> settle;  ///< as Engine::settle says of its work
};

/// A cell of each method that is asked for: settled, sampled interleaved with the others, and judged.
void measure_methods(const AxisRun& run, std::string_view axis, const SceneFacts& input,
                     std::span<const AxisMethod> methods);

/// A way to sum the surface area cost of a tree, on the axis sums.
struct SumMethod {
    std::string_view name;
    /// With the usual node costs; of a root that has an area.
    double (*cost)(const HostTree& tree);
    bool is_ours = false;  ///< what the counter sah_cost is made by
};

/// In the order of tables.
std::span<const SumMethod> sum_methods();

/// The reference: areas and sums in long double, 64 bits of mantissa on x86.
long double cost_in_long_double(const HostTree& tree);

void measure_narrow(const AxisRun& run);
void measure_swept(const AxisRun& run);
void measure_sums(const AxisRun& run, const SceneFacts& scene, const Input& input);
void measure_codes(const AxisRun& run, const SceneFacts& scene, const Input& input);
void measure_input(const AxisRun& run, const SceneFacts& scene, const Input& input);
void measure_boxes(const AxisRun& run, const SceneFacts& scene, const Input& input);

}  // namespace bvhbench
