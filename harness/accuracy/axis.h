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

#include "harness/progress.h"
#include "harness/record.h"
#include "harness/run.h"
#include "harness/session.h"

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
    /// Its cells of a document as a table; empty if there are none.
    std::string (*report)(const Document& document);
};

/// Every axis, in the order in which they are run.
std::span<const Axis> accuracy_axes();

/// By name. Throws BadUsage with the known names when there is none.
const Axis& find_axis(std::string_view name);

/// The tables of all axes that a document has cells of.
std::string accuracy_report(const Document& document);

/// A cell that says what is measured: on which axis, of what, by which method.
Cell accuracy_cell(std::string axis, std::string method, SceneFacts input);

/// A cell on its way to being measured, and what one sample of it is; without, it is finished already.
struct Measured {
    Cell cell;
    std::function<std::vector<StageTime>()> once;

    /// It has no numbers, and why. What it left in the queue is forgotten.
    void fail(Session& session, const std::string& why);
};

/// Sample all of them interleaved, after warm_up samples that do not count. One that fails says so.
void take_samples_of(const AxisRun& run, std::span<Measured> cells);

/// The first line of why a cell has no numbers, or what is wrong with it; for tables.
std::string why_text(const Cell& cell);

/// The cells of a document that are on an axis and have times, or a reason for having none.
std::vector<const Cell*> cells_of(const Document& document, std::string_view axis);

}  // namespace bvhbench
