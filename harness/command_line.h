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

}  // namespace bvhbench
