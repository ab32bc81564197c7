// SPDX-License-Identifier: MIT
#include "harness/sweep/time_left.h"

#include <algorithm>
#include <cmath>

namespace bvhbench {

void TimeLeft::add(const std::string& kind, std::int64_t triangles, double seconds)
{
    const Done done{static_cast<double>(triangles), seconds};
    all_.push_back(done);
    of_kind_[kind].push_back(done);
}

bool TimeLeft::has_sizes(const std::vector<Done>& done)
{
    return std::any_of(done.begin(), done.end(),
                       [&](const Done& one) { return one.triangles != done.front().triangles; });
}

/// A time to start and one a triangle by least squares, neither of them negative. Of one size only, starting is taken to
/// cost as much as `start_triangles`.
double TimeLeft::estimate(const std::vector<Done>& done, double triangles)
{
    double count = 0, sum_x = 0, sum_y = 0;
    for (const Done& one : done) {
        count += 1;
        sum_x += one.triangles;
        sum_y += one.seconds;
    }
    const double mean_x = sum_x / count, mean_y = sum_y / count;
    if (triangles <= 0)
        return mean_y;
    if (!has_sizes(done))
        return mean_y * (start_triangles + triangles) / (start_triangles + mean_x);
    double xx = 0, xy = 0;
    for (const Done& one : done) {
        xx += (one.triangles - mean_x) * (one.triangles - mean_x);
        xy += (one.triangles - mean_x) * (one.seconds - mean_y);
    }
    const double slope = std::max(xy / xx, 0.0), start = mean_y - slope * mean_x;
    return start >= 0 ? start + slope * triangles : sum_y / sum_x * triangles;
}

double TimeLeft::seconds_of(const std::string& kind, std::int64_t triangles) const
{
    const auto found = of_kind_.find(kind);
    const bool tells = found != of_kind_.end() && (has_sizes(found->second) || !has_sizes(all_));
    return estimate(tells ? found->second : all_, static_cast<double>(triangles));
}

std::string rough_time(double seconds)
{
    const auto whole = static_cast<long>(std::ceil(std::max(seconds, 1.0)));
    const auto spelled = [](long large, const char* unit, long small, const char* small_unit) {
        return std::to_string(large) + unit +
               (small > 0 ? ' ' + std::to_string(small) + small_unit : "");
    };
    if (whole < 90)
        return std::to_string(whole) + " s";
    const long minutes = (whole + 59) / 60;
    if (minutes < 90)
        return std::to_string(minutes) + " min";
    if (minutes < 48 * 60)
        return spelled(minutes / 60, " h", minutes % 60, " min");
    return spelled(minutes / 60 / 24, " d", minutes / 60 % 24, " h");
}

}  // namespace bvhbench
