// SPDX-License-Identifier: MIT
//
// Options that several commands share.
#pragma once

#include <CLI/CLI.hpp>

#include "harness/base/common_options.h"
#include "harness/choice/sampling.h"

namespace bvhbench {

void add_common(CLI::App& app, CommonOptions& common);

/// Adds --samples and the other sampling options. Without `samples`, the number of samples, there is no default.
void add_sampling(CLI::App& app, int& samples, const char* help, SamplingWords& sampling);

/// Adds the options for end-point overlap and node costs.
void add_quality(CLI::App& app, bool& quality, NodeCosts& costs);

}  // namespace bvhbench
