// SPDX-License-Identifier: MIT
//
// The words of each command's line. What they mean together, options.cpp finds out once they are parsed.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "harness/options.h"

namespace bvhbench {

/// Accepts a number from 0 to `most`: CLI::Range lets NaN pass.
CLI::Validator a_number(int most);

/// Accepts only `known` words; the answer to another one lists them.
CLI::Validator one_of(std::vector<std::string> known);

constexpr int most_samples = 1000000;

/// Where leaf boxes are kept, and in what; `leaves` stays empty where nothing is said of them.
void add_leaves(CLI::App& command, std::string& leaves, std::string& boxes);

/// What end-point overlap and the costs of nodes are asked for by.
void add_quality(CLI::App& command, bool& quality, NodeCosts& costs);

/// Turns "5%" or "0.05" into 0.05: a share from 0 to `most`.
CLI::Validator a_share(double most);

void add_list(CLI::App& app, ListCommand& list);
void add_build(CLI::App& app, BuildCommand& build, std::string& leaves);
void add_collide(CLI::App& app, CollideCommand& collide, std::string& leaves, std::string& adjacent,
                 std::string& pairs_of, std::vector<std::string>& no_skip);
void add_run(CLI::App& app, RunCommand& run);
void add_reproduce(CLI::App& app, ReproduceCommand& reproduce);
void add_check(CLI::App& app, CheckCommand& check);
void add_show(CLI::App& app, ShowCommand& show);
void add_accuracy(CLI::App& app, AccuracyCommand& accuracy);
void add_tune(CLI::App& app, TuneCommand& tune, std::string& leaves, std::string& adjacent);
void add_stress(CLI::App& app, StressCommand& stress);
void add_sweep(CLI::App& app, SweepCommand& sweep);
void add_merge(CLI::App& app, MergeCommand& merge);
void add_plot(CLI::App& app, PlotCommand& plot);
void add_report(CLI::App& app, ReportCommand& report, std::string& leaves);
void add_compare(CLI::App& app, CompareCommand& compare);
void add_smoke(CLI::App& app, SmokeCommand& smoke);

}  // namespace bvhbench
