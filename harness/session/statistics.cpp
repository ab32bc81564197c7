// SPDX-License-Identifier: MIT
#include "harness/session/statistics.h"

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

double whole_ns(const std::vector<StageTime>& stages)
{
    double sum = 0;
    std::int64_t end = 0;
    bool on_device = true;
    for (const StageTime& time : stages) {
        sum += static_cast<double>(time.elapsed_ns());
        end = std::max(end, time.start_ns + time.span_ns);
        on_device = on_device && time.wall_ns == 0;
    }
    return on_device ? std::max(sum, static_cast<double>(end)) : sum;
}

}  // namespace bvhbench
