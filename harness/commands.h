// SPDX-License-Identifier: MIT
//
// What bvhbench does, a function a command. Each prints to stdout and returns the exit code: 0 done, 1 a check
// differs. Errors are thrown to main.
#pragma once

#include "harness/options.h"

namespace bvhbench {

int list(const ListCommand& command, const Options& options);
int build(const BuildCommand& command, const Options& options);
int collide(const CollideCommand& command, const Options& options);
int run(const RunCommand& command, const Options& options);
int reproduce(const ReproduceCommand& command, const Options& options);

/// What `reproduce` takes: the paper's tables and figures by name, and "all".
std::vector<std::string> reproducible();

int check(const CheckCommand& command, const Options& options);
int show(const ShowCommand& command, const Options& options);
int tune(const TuneCommand& command, const Options& options);
int accuracy(const AccuracyCommand& command, const Options& options);
int stress(const StressCommand& command, const Options& options);
int sweep(const SweepCommand& command, const Options& options);
int merge(const MergeCommand& command, const Options& options);
int plot(const PlotCommand& command, const Options& options);
int report(const ReportCommand& command, const Options& options);
int compare(const CompareCommand& command, const Options& options);
int smoke(const SmokeCommand& command, const Options& options);

/// The command that `options` hold.
int execute(const Options& options);

/// Parses `argv`, runs the command and returns the exit code. An error is one sentence on standard error. 0 done, 1 a check differs, 2 wrong usage, 3 no device, file, library
/// or memory, 4 nothing was measured. May be called again and again.
int run_program(int argc, const char* const* argv);

}  // namespace bvhbench
