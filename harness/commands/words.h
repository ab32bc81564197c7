// SPDX-License-Identifier: MIT
//
// Options that several commands share, and validators of their values.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "harness/base/common_options.h"
#include "harness/choice/sampling.h"

namespace bvhbench {

/// Accepts a number from 0 to `most`. CLI::Range would accept NaN.
CLI::Validator a_number(int most);

/// Accepts only the words in `known`; the error message lists them.
CLI::Validator one_of(std::vector<std::string_view> known);

/// Accepts a fraction from 0 to `most`, as "5%" or "0.05", and replaces it by its decimal: 0.05.
CLI::Validator a_share(double most);

void add_common(CLI::App& app, CommonOptions& common);

/// Adds the sampling options. The command must already have --samples, which --until excludes.
void add_sampling(CLI::App& app, SamplingWords& sampling);

/// Adds the options for end-point overlap and node costs.
void add_quality(CLI::App& app, bool& quality, NodeCosts& costs);

}  // namespace bvhbench
