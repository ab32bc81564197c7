// SPDX-License-Identifier: MIT
#include "harness/record/finding.h"

#include <algorithm>
#include <ranges>

namespace bvhbench {

void join(Finding& all, const Finding& more)
{
    if (more.verdict > all.verdict) {
        all.verdict = more.verdict;
        all.detail = more.detail;
    }
    all.checked += more.checked;
    all.wrong += more.wrong;
    all.missed += more.missed;
}

void join(Findings& all, const Findings& more)
{
    for (const auto& [invariant, finding] : more)
        if (const auto [at, is_new] = all.try_emplace(invariant, finding); !is_new)
            join(at->second, finding);
}

Findings with_words(std::string_view words, Findings findings)
{
    for (auto& [invariant, finding] : findings)
        if (!finding.detail.empty())
            finding.detail = std::string(words) + ": " + finding.detail;
    return findings;
}

bool is_any_broken(const Findings& findings)
{
    return std::ranges::count(findings | std::views::values, Finding::Verdict::broken,
                              &Finding::verdict) > 0;
}

bool is_refused(const StressCell& cell)
{
    return cell.kind != StressCell::Kind::host && !cell.findings.empty() &&
           std::ranges::all_of(cell.findings | std::views::values, [](const Finding& one) {
               return one.verdict == Finding::Verdict::refused;
           });
}

bool is_our_fault(const StressCell& cell)
{
    return cell.library.empty() && is_any_broken(cell.findings);
}

}  // namespace bvhbench
