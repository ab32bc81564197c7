// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "harness/record.h"

namespace bvhbench {

struct CompareRules;

/// Sentences on what is no time: those to fail for, and others.
struct FactChanges {
    std::vector<std::string> regressions, changes;
};

/// Of two cells of one identity: verdicts, hashes of answers, counters that are exact. Of other devices verdicts only.
FactChanges fact_changes(const Cell& first, const Cell& second, const CompareRules& rules);

/// Circumstances that two runs do not share.
std::vector<std::string> run_remarks(const RunFacts& first, const RunFacts& second);

}  // namespace bvhbench
