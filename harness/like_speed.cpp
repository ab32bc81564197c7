// SPDX-License-Identifier: MIT
#include "harness/like_speed.h"

#include <algorithm>
#include <cmath>

#include "harness/sample_times.h"
#include "harness/statistics.h"

namespace bvhbench {
namespace {

constexpr double likeness = 0.05;
constexpr std::size_t parts = 8;
constexpr double of_most =
    4.5;  ///< standard errors from the least of so many parts to the most, by chance
constexpr std::size_t beside = 2;  ///< samples before and after

double log_speed(const Sample& sample)
{
    return std::log(static_cast<double>(sample.calibration_ns));
}

bool is_calibrated(const Cell& cell)
{
    return std::all_of(cell.samples.begin(), cell.samples.end(),
                       [](const Sample& sample) { return sample.calibration_ns > 0; });
}

/// How many of the ascending `speeds` are near `speed`.
std::size_t near(const std::vector<double>& speeds, double speed)
{
    const auto begin = std::lower_bound(speeds.begin(), speeds.end(), speed - likeness);
    const auto end = std::upper_bound(begin, speeds.end(), speed + likeness);
    return static_cast<std::size_t>(end - begin);
}

/// The speed that both have the most samples near of.
double shared_speed(std::vector<double> first, std::vector<double> second)
{
    std::sort(first.begin(), first.end());
    std::sort(second.begin(), second.end());
    double best = 0;
    std::size_t most = 0;
    for (const std::vector<double>* speeds : {&first, &second})
        for (const double speed : *speeds)
            if (const std::size_t count = std::min(near(first, speed), near(second, speed));
                count > most) {
                most = count;
                best = speed;
            }
    return best;
}

std::vector<const Sample*> samples_near(const Cell& cell, double speed)
{
    std::vector<const Sample*> chosen;
    for (const Sample& sample : cell.samples)
        if (std::fabs(log_speed(sample) - speed) <= likeness)
            chosen.push_back(&sample);
    return chosen;
}

/// The standard error of the logarithm of a part's median, from how samples lie about the medians of their parts.
double median_error(const std::vector<std::vector<double>>& in_part)
{
    std::vector<double> distances;
    for (const std::vector<double>& times : in_part)
        for (const double time : times)
            distances.push_back(std::fabs(std::log(time / quantile(times, 0.5))));
    const double each = static_cast<double>(distances.size()) / parts;
    return each > 0 ? 1.2533 * 1.4826 * quantile(distances, 0.5) / std::sqrt(each) : 0;
}

}  // namespace

std::vector<SamplePair> counted_pairs(const std::vector<std::pair<const Cell*, const Cell*>>& cells)
{
    std::vector<SamplePair> counted;
    for (const auto& [first, second] : cells)
        counted.push_back({counted_samples(first->samples), counted_samples(second->samples)});
    return counted;
}

std::vector<SamplePair> at_like_speed(const std::vector<std::pair<const Cell*, const Cell*>>& cells)
{
    if (!std::all_of(cells.begin(), cells.end(), [](const auto& cell) {
            return is_calibrated(*cell.first) && is_calibrated(*cell.second);
        }))
        return counted_pairs(cells);
    std::vector<double> first, second;
    for (const auto& cell : cells) {
        for (const Sample& sample : cell.first->samples)
            first.push_back(log_speed(sample));
        for (const Sample& sample : cell.second->samples)
            second.push_back(log_speed(sample));
    }
    std::vector<SamplePair> chosen;
    const double speed = shared_speed(std::move(first), std::move(second));
    for (const auto& cell : cells)
        chosen.push_back({samples_near(*cell.first, speed), samples_near(*cell.second, speed)});
    return chosen;
}

double wavering(const std::vector<std::vector<const Sample*>>& cells)
{
    int begin = 0;
    int end = 0;
    for (const auto& samples : cells)
        if (!samples.empty()) {
            begin = end == 0 ? samples.front()->order : std::min(begin, samples.front()->order);
            end = std::max(end, samples.back()->order + 1);
        }
    std::vector<std::vector<double>> slower(parts);  // of each part, a value a cell
    std::vector<double> errors;                      // of a part's median, a value a cell
    for (const auto& samples : cells) {
        const std::vector<double> times = times_of(samples);
        std::vector<std::vector<double>> in_part(parts);
        for (std::size_t i = 0; i < samples.size(); ++i)
            in_part[static_cast<std::size_t>(samples[i]->order - begin) * parts /
                    static_cast<std::size_t>(end - begin)]
                .push_back(times[i]);
        const double median = quantile(times, 0.5);
        errors.push_back(median_error(in_part));
        for (std::size_t part = 0; part < parts; ++part)
            if (in_part[part].size() >= 3 && median > 0)
                slower[part].push_back(std::log(quantile(in_part[part], 0.5) / median));
    }
    std::vector<double> of_parts;
    for (const std::vector<double>& part : slower)
        if (!part.empty())
            of_parts.push_back(quantile(part, 0.5));
    if (of_parts.empty())
        return 0;
    const auto [least, most] = std::minmax_element(of_parts.begin(), of_parts.end());
    const double chance =
        of_most * quantile(errors, 0.5) / std::sqrt(static_cast<double>(errors.size()));
    return std::max(0.0, *most - *least - chance);
}

std::vector<double> common_trend(const std::vector<SamplePair>& cells)
{
    std::vector<std::vector<double>> slower;  // of each place, a value a cell and file
    for (const SamplePair& cell : cells)
        for (const auto* samples : {&cell.first, &cell.second}) {
            const std::vector<double> times = times_of(*samples);
            const double median = quantile(times, 0.5);
            if (!(median > 0))
                continue;
            slower.resize(std::max(slower.size(), times.size()));
            for (std::size_t i = 0; i < times.size(); ++i)
                slower[i].push_back(std::log(std::max(times[i], 1.0) / median));
        }
    std::vector<double> trend;
    for (std::size_t i = 0; i < slower.size(); ++i) {
        std::vector<double> near_by;
        const std::size_t end = std::min(slower.size(), i + beside + 1);
        for (std::size_t k = i < beside ? 0 : i - beside; k < end; ++k)
            near_by.insert(near_by.end(), slower[k].begin(), slower[k].end());
        trend.push_back(quantile(std::move(near_by), 0.5));
    }
    return trend;
}

std::vector<double> times_of(const std::vector<const Sample*>& samples, std::string_view stage)
{
    std::vector<double> times;
    for (const Sample* sample : samples) {
        if (stage.empty())
            times.push_back(whole_ns(sample->stages));
        for (const StageTime& time : sample->stages)
            if (time.stage == stage)
                times.push_back(static_cast<double>(time.elapsed_ns()));
    }
    return times;
}

}  // namespace bvhbench
