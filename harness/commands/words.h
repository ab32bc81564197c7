// SPDX-License-Identifier: MIT
//
// Options that several commands have, and what their values may be.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "harness/base/common_options.h"
#include "harness/choice/sampling.h"

namespace bvhbench {

/// Accepts a number from 0 to `most`: CLI::Range lets NaN pass.
CLI::Validator a_number(int most);

/// Accepts only `known` words; the answer to another one lists them.
CLI::Validator one_of(std::vector<std::string_view> known);

/// Turns "5%" or "0.05" into 0.05: a share from 0 to `most`.
CLI::Validator a_share(double most);

void add_common(CLI::App& app, CommonOptions& common);

/// How samples are taken, behind --samples, which --until is instead of.
void add_sampling(CLI::App& app, SamplingWords& sampling);

/// What end-point overlap and the costs of nodes are asked for by.
void add_quality(CLI::App& app, bool& quality, NodeCosts& costs);

}  // namespace bvhbench
