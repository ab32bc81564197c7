// SPDX-License-Identifier: MIT
//
// Options that several commands share.
#pragma once

#include <CLI/CLI.hpp>

#include "harness/base/common_options.h"
#include "harness/choice/choices.h"
#include "harness/choice/sampling.h"

namespace bvhbench {

void add_common(CLI::App& app, CommonOptions& common);

/// Adds --samples and the other sampling options. Without `samples`, the number of samples, there is no default.
void add_sampling(CLI::App& app, int& samples, const char* help, SamplingWords& sampling);

/// Builders, orders and colliders of a command line. Each may be several names, separated by commas or blanks.
struct SeveralNames {
    std::vector<std::string> builders, orders{"morton30"}, colliders;

    void add_builders(CLI::App& app);
    void add_orders(CLI::App& app);

    /// Returns `choice` with each combination of the names. A collider that queries no tree is combined once, and a
    /// builder whose leaves have an order of their own once with no order. Throws BadUsage for
    /// a wrong combination or an unknown name.
    std::vector<CellChoice> combined_with(const CellChoice& choice) const;
};

/// Adds the options for end-point overlap and node costs.
void add_quality(CLI::App& app, bool& quality, NodeCosts& costs);

}  // namespace bvhbench
