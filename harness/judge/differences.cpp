// SPDX-License-Identifier: MIT
#include "harness/judge/differences.h"

namespace bvhbench {

Differences differences(const PairList& found, const PairList& right)
{
    Differences counts{0, found.surplus()};
    auto one = found.pairs().begin();
    auto other = right.pairs().begin();
    while (one != found.pairs().end() && other != right.pairs().end()) {
        counts.false_ones += *one < *other ? 1 : 0;
        counts.missed += *other < *one ? 1 : 0;
        const bool step = *one <= *other, step_other = *other <= *one;
        one += step ? 1 : 0;
        other += step_other ? 1 : 0;
    }
    counts.false_ones += static_cast<std::uint64_t>(found.pairs().end() - one);
    counts.missed += static_cast<std::uint64_t>(right.pairs().end() - other);
    return counts;
}

}  // namespace bvhbench
