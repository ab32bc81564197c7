// SPDX-License-Identifier: MIT
//
// Options that several commands share.
#pragma once

#include <CLI/CLI.hpp>

#include "collide/best_pipeline.h"
#include "harness/base/common_options.h"
#include "harness/choice/choices.h"
#include "harness/choice/sampling.h"

namespace bvhbench {

void add_common(CLI::App& app, CommonOptions& common);

/// Adds --samples and the other sampling options. Without `samples`, the number of samples, there is no default.
void add_sampling(CLI::App& app, int& samples, const char* help, SamplingWords& sampling);

constexpr int any_number = CLI::detail::expected_max_vector_size;

/// Adds an option that takes up to `most` names, separated by commas or blanks.
CLI::Option* add_names(CLI::App& app, const char* option, std::vector<std::string>& names,
                       const char* help, int most = any_number);

/// Builders, orders and colliders of a command line. Each may be several names, separated by commas or blanks.
struct SeveralNames {
    static constexpr std::string_view paper_order = "morton30";
    std::vector<std::string> builders, orders, colliders;

    /// Adds the options of all three, which take `most` names each and may be left out.
    void add_to(CLI::App& app, int most = any_number);

    /// Names the best where nothing is named. Leaves are sorted if the builder is the best; an order is then the best's too, or else the
    /// paper's. Returns a line about what it named; nothing if all was. Throws BadUsage for an unknown collider.
    std::string take_best(const BestPipeline& best, BuilderChoice& builder);

    /// Returns `choice` with each combination of the names. A collider that queries no tree is combined once, and a
    /// builder whose leaves have an order of their own once with no order. Throws BadUsage for
    /// a wrong combination or an unknown name.
    std::vector<CellChoice> combined_with(const CellChoice& choice) const;
};

/// Adds the options for end-point overlap and node costs.
void add_quality(CLI::App& app, bool& quality, NodeCosts& costs);

}  // namespace bvhbench
