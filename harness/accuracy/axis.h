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
};

struct Axis {
    std::string_view name;      ///< the key on the command line and in result files
    std::string_view question;  ///< one line
    /// Cells that cannot be had, for want of a scene or a reference, say so.
    void (*measure)(const AxisRun& run);
};

/// Every axis, in the order in which they are run.
std::span<const Axis> accuracy_axes();

/// By name. Throws BadUsage with the known names when there is none.
const Axis& find_axis(std::string_view name);

/// A cell that says what is measured: on which axis, of what, by which method.
Cell accuracy_cell(std::string axis, std::string method, SceneFacts input);

/// The cell has no numbers, and why, and is not sampled. What it left in the queue is forgotten.
void fail(Session& session, Subject& subject, const std::string& why);

/// Samples all that have something to sample, interleaved, after a warm-up sample. One that fails says so, as fail() does.
void take_samples_of(const AxisRun& run, std::span<Subject> cells);

}  // namespace bvhbench
