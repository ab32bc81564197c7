// SPDX-License-Identifier: MIT
#include "harness/sample_times.h"

#include <algorithm>

namespace bvhbench {

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

std::vector<const Sample*> counted_samples(const std::vector<Sample>& samples)
{
    const auto drifted =
        std::count_if(samples.begin(), samples.end(), [](const Sample& s) { return s.drifted; });
    const bool all = 2 * static_cast<std::size_t>(drifted) > samples.size();
    std::vector<const Sample*> counted;
    for (const Sample& sample : samples)
        if (all || !sample.drifted)
            counted.push_back(&sample);
    return counted;
}

}  // namespace bvhbench
