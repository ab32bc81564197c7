// SPDX-License-Identifier: MIT
#include "harness/statistics.h"

#include <algorithm>
#include <cstddef>

namespace bvhbench {

double quantile(std::vector<double> values, double fraction)
{
    if (values.empty())
        return 0;
    std::sort(values.begin(), values.end());
    const double position = fraction * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] +
           (position - static_cast<double>(below)) * (values[above] - values[below]);
}

Spread spread_of(const std::vector<double>& values)
{
    return {quantile(values, 0.5), quantile(values, 0.1), quantile(values, 0.9),
            quantile(values, 0.25), quantile(values, 0.75)};
}

}  // namespace bvhbench
