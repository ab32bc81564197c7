// SPDX-License-Identifier: MIT
#include "harness/compare.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "harness/cell_identity.h"
#include "harness/compare_facts.h"
#include "harness/like_speed.h"
#include "harness/mann_whitney.h"
#include "harness/report.h"
#include "harness/sample_times.h"
#include "harness/statistics.h"

namespace bvhbench {
namespace {

/// Fewer, and one that was changed moves the median of all.
constexpr std::size_t fewest_cells = 4;

/// Logarithm of a ratio that no state of a machine makes, by what was seen on a shared host: beyond it a cell has changed,
/// however little the others agree.
constexpr double most_drift = 0.47;  // 1.6

/// Cells whose times may be held against each other: those of one scene and frame, by other builders or colliders.
std::string group_of(const Cell& cell)
{
    return cell.experiment + '\n' + cell.scene.name + '\n' + std::to_string(cell.scene.frame) +
           '\n' + std::string(operation_name(cell.operation)) + '\n' + cell.swept.pairs + '\n' +
           cell.accuracy.axis + (starts_from_leaves(cell) ? "\nleaves" : "");
}

bool both_have_times(const ComparedCell& cell)
{
    return has_times(*cell.first) && has_times(*cell.second);
}

TimeVerdict verdict_of(const TimeChange& change, double threshold, double error)
{
    if (std::min(change.first_count, change.second_count) < fewest_samples)
        return TimeVerdict::unsure;
    const Interval& ratio = change.ratio;
    const bool differs = change.p < error && (ratio.low > 1 || ratio.high < 1);
    if (differs && ratio.value >= 1 + threshold)
        return TimeVerdict::slower;
    if (differs && ratio.value <= 1 / (1 + threshold))
        return TimeVerdict::faster;
    if (ratio.low > 1 / (1 + threshold) && ratio.high < 1 + threshold)
        return TimeVerdict::same;
    return TimeVerdict::unsure;
}

/// What a scene's cells are judged against.
struct Circumstances {
    std::vector<SamplePair> samples;  ///< of each cell
    std::vector<double> trend;    ///< of samples by their place, where runs took turns; else empty
    Interval common = {1, 1, 1};  ///< ratio that is not a cell's own
};

/// Times without the trend that both runs share.
std::vector<double> without_trend(std::vector<double> times, const std::vector<double>& trend)
{
    for (std::size_t i = 0; i < std::min(times.size(), trend.size()); ++i)
        times[i] *= std::exp(-trend[i]);
    return times;
}

void compare_times(ComparedCell& cell, const SamplePair& samples, const Circumstances& under,
                   const CompareRules& rules, double error)
{
    const auto change = [&](std::string_view stage) {
        return time_change(without_trend(times_of(samples.first, stage), under.trend),
                           without_trend(times_of(samples.second, stage), under.trend),
                           rules.threshold, error, under.common);
    };
    cell.time = change({});
    if (cell.first->samples.front().stages.size() < 2)
        return;
    for (const StageTime& stage : cell.first->samples.front().stages)
        if (!times_of(samples.second, stage.stage).empty())
            cell.stages.emplace_back(stage.stage, change(stage.stage));
}

double median_of(std::vector<double> values) { return quantile(std::move(values), 0.5); }

/// The cells' median ratio between two runs that were apart, of those with samples enough, and by how much a ratio may be off it
/// by chance: three standard deviations, as the median of their distances tells them where a few of them are changed.
SceneChange scene_change(const std::vector<ComparedCell*>& cells,
                         const std::vector<SamplePair>& samples, bool is_one_device)
{
    SceneChange change{.scene = cells.front()->first};
    std::vector<double> ratios, distances;
    for (const SamplePair& pair : samples)
        if (std::min(pair.first.size(), pair.second.size()) >= fewest_samples)
            ratios.push_back(
                std::log(median_of(times_of(pair.second)) / median_of(times_of(pair.first))));
    change.cells = ratios.size();
    change.is_common = ratios.size() >= (is_one_device ? fewest_cells : 2);
    const double ratio = median_of(ratios);
    for (const double one : ratios)
        distances.push_back(std::fabs(one - ratio));
    constexpr double deviations = 3 * 1.4826;
    const double spread = std::min(deviations * median_of(distances), most_drift);
    change.spread = is_one_device ? std::exp(spread) : 1;
    std::vector<std::vector<const Sample*>> first, second;
    for (const SamplePair& pair : samples) {
        first.push_back(pair.first);
        second.push_back(pair.second);
    }
    const double margin =
        std::exp(std::hypot(wavering(first) + wavering(second),
                            spread / std::sqrt(static_cast<double>(ratios.size()))));
    change.ratio = {std::exp(ratio) / margin, std::exp(ratio), std::exp(ratio) * margin};
    return change;
}

TimeVerdict verdict_of_scene(const Interval& ratio, double threshold)
{
    if (ratio.low > 1 && ratio.value >= 1 + threshold)
        return TimeVerdict::slower;
    if (ratio.high < 1 && ratio.value <= 1 / (1 + threshold))
        return TimeVerdict::faster;
    return ratio.low > 1 / (1 + threshold) && ratio.high < 1 + threshold ? TimeVerdict::same
                                                                         : TimeVerdict::unsure;
}

std::vector<SamplePair> all_samples(const std::vector<std::pair<const Cell*, const Cell*>>& cells)
{
    std::vector<SamplePair> all(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        for (const Sample& sample : cells[i].first->samples)
            all[i].first.push_back(&sample);
        for (const Sample& sample : cells[i].second->samples)
            all[i].second.push_back(&sample);
    }
    return all;
}

/// All timed cells of one scene.
void compare_scene(const std::vector<ComparedCell*>& cells, double error, Comparison& comparison)
{
    const CompareRules& rules = comparison.rules;
    std::vector<std::pair<const Cell*, const Cell*>> both;
    for (const ComparedCell* cell : cells)
        both.emplace_back(cell->first, cell->second);
    Circumstances under;
    if (comparison.by_turns) {
        under.samples = all_samples(both);
        under.trend = common_trend(under.samples);
    } else {
        under.samples = rules.other_devices ? counted_pairs(both) : at_like_speed(both);
        SceneChange change = scene_change(cells, under.samples, !rules.other_devices);
        const double value = change.ratio.value;
        under.common = change.is_common
                           ? Interval{value / change.spread, value, value * change.spread}
                           : Interval{change.ratio.low / value, 1, change.ratio.high / value};
        change.verdict = verdict_of_scene(change.ratio, rules.threshold);
        if (change.is_common && !rules.other_devices)
            comparison.scenes.push_back(change);
        else if (!change.is_common && rules.other_devices)
            return;  // nothing to hold them against
    }
    for (std::size_t i = 0; i < cells.size(); ++i)
        compare_times(*cells[i], under.samples[i], under, rules, error);
}

bool has(const std::vector<std::string>& ids, const std::string& id)
{
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

std::string_view time_verdict_text(TimeVerdict verdict)
{
    constexpr std::string_view words[] = {"SAME", "FASTER", "SLOWER", "UNSURE"};
    return words[static_cast<std::size_t>(verdict)];
}

bool Comparison::has_regression() const
{
    return (!rules.allow_missing && !only_first.empty()) ||
           std::any_of(cells.begin(), cells.end(),
                       [](const ComparedCell& cell) { return cell.is_regression(); }) ||
           std::any_of(scenes.begin(), scenes.end(), [](const SceneChange& scene) {
               return scene.verdict == TimeVerdict::slower;
           });
}

TimeChange time_change(const std::vector<double>& first, const std::vector<double>& second,
                       double threshold, double error, const Interval& common)
{
    TimeChange change;
    change.first_count = first.size();
    change.second_count = second.size();
    change.first = median_interval(first, error);
    change.second = median_interval(second, error);
    change.ratio = ratio_interval(ratio_interval(change.second, change.first), common);
    std::vector<double> scaled = second;
    for (double& time : scaled)
        time /= common.value;
    change.p = mann_whitney(first, scaled).p;
    change.verdict = verdict_of(change, threshold, error);
    return change;
}

Comparison compare_documents(const Document& first, const Document& second,
                             const CompareRules& rules)
{
    Comparison comparison;
    comparison.rules = rules;
    comparison.by_turns =
        has(first.run.turns_with, second.run.id) && has(second.run.turns_with, first.run.id);
    comparison.remarks = run_remarks(first.run, second.run);
    MatchedCells matched = matched_cells(first.cells, second.cells);
    comparison.only_first = std::move(matched.only_first);
    comparison.only_second = std::move(matched.only_second);
    std::size_t timed = 0;
    for (const auto& [a, b] : matched.both) {
        ComparedCell cell;
        cell.first = a;
        cell.second = b;
        FactChanges facts = fact_changes(*a, *b, rules);
        cell.regressions = std::move(facts.regressions);
        cell.changes = std::move(facts.changes);
        timed += both_have_times(cell) ? 1 : 0;
        comparison.cells.push_back(std::move(cell));
    }
    // Bonferroni: a gate that goes off once in twenty comparisons of hundreds of cells is one that is looked at.
    comparison.error_of_each = rules.error / static_cast<double>(std::max<std::size_t>(1, timed));

    std::map<std::string, std::vector<ComparedCell*>> scenes;
    for (ComparedCell& cell : comparison.cells)
        if (both_have_times(cell))
            scenes[group_of(*cell.first)].push_back(&cell);
        else if (cell.first->samples.empty() && cell.second->samples.empty())
            cell.time.verdict = TimeVerdict::same;  // what there is of it, facts, is compared above
    for (const auto& [group, cells] : scenes)
        compare_scene(cells, comparison.error_of_each, comparison);
    return comparison;
}

}  // namespace bvhbench
