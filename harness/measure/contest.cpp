// SPDX-License-Identifier: MIT
#include "harness/measure/contest.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/base/table.h"
#include "harness/judge/metrics.h"
#include "harness/session/race.h"
#include "harness/session/sampler.h"

namespace bvhbench {
namespace {

constexpr const char* stages[] = {"bounds",    "codes",     "sort",  "order",    "gather",
                                  "hierarchy", "to_device", "ropes", "collapse", "broad",
                                  "copy",      "narrow",    "pad",   "exact"};

std::string numbers(auto... values) { return (... + (' ' + std::to_string(values))); }

/// Returns a text that is equal for two colliders if they answer the same question.
std::string question_of(const ColliderChoice& collider)
{
    return numbers(static_cast<int>(collider.among), collider.keep_adjacent, collider.rules_off,
                   collider.rules_forced, static_cast<int>(collider.update), collider.first) +
           ' ' + collider.within;
}

/// Returns a text that is equal for two cells if the stage does the same work in both.
std::string key_of(const std::string& stage, const Cell& cell)
{
    const BuilderChoice& builder = cell.builder;
    const ColliderChoice& collider = cell.collider;
    std::string key = stage + ' ' + builder.boxes + (builder.sorted_leaves ? " sorted" : " mesh") +
                      (collider.trees == TreeOver::scene ? " one tree" : "");
    if (is_of_query(stage))
        key += question_of(collider);
    if (stage == "narrow")
        return key + ' ' + collider.narrow;
    if (builder.name == "none")
        return key + ' ' + collider.name;
    if (stage == "hierarchy")
        return key + ' ' + builder.name + numbers(builder.group_size, builder.items);
    const std::string_view equal = find_builder(builder.name).oracle;
    key += ' ' + (equal.empty() ? builder.name : std::string(equal));
    if (stage != "ropes")
        key += ' ' + builder.order + (builder.grid == GridOver::scene ? " scene" : "");
    if (is_of_query(stage))
        key +=
            ' ' + collider.name + numbers(collider.jump, collider.start_level, collider.group_size);
    return key + numbers(builder.group_size, builder.items);
}

/// Returns a text that is equal for two cells if the same collider queries trees of the same kind, along any order.
std::string key_of_kind(const Cell& cell)
{
    const BuilderChoice& builder = cell.builder;
    const std::string_view equal =
        builder.name == "none" ? builder.name : find_builder(builder.name).oracle;
    return cell.collider.name + question_of(cell.collider) +
           (cell.collider.trees == TreeOver::scene ? " over one " : " over ") +
           (equal.empty() ? builder.name : std::string(equal));
}

bool tells(const Cell& cell)
{
    return cell.status == Cell::Status::measured && cell.check.verdict != Check::Verdict::differs &&
           !cell.samples.empty();
}

}  // namespace

bool Contest::can_judge(const ColliderChoice& collider) const
{
    return !has_later_frames_ ||
           !(collider.update == FrameUpdate::refit ||
             (collider.update == FrameUpdate::automatic && find_collider(collider.name).refits));
}

double bytes_held(const Cell& cell)
{
    const auto counter = [&](const char* name) {
        const auto found = cell.counters.find(name);
        return found == cell.counters.end() ? 0 : found->second;
    };
    const double all = counter("memory_bytes");
    return all > 0 ? all : counter("tree_bytes") + counter("scratch_bytes");
}

void Contest::keep_least(const std::string& key, double ns)
{
    double& least = least_.try_emplace(key, ns).first->second;
    least = std::min(least, ns);
}

double Contest::least_of(const std::string& key) const
{
    const auto found = least_.find(key);
    return found == least_.end() ? 0 : found->second;
}

void Contest::count_areas(const Pipeline& pipeline, const Input& input, Cell& cell) const
{
    if (race_ == Race::none || pipeline.tree() == nullptr || input.objects.size() > 1 ||
        cell.check.verdict == Check::Verdict::differs)
        return;
    if (const std::optional<AreaSums> sums = area_sums(pipeline.tree()->to_host_tree())) {
        cell.counters["sah_inner"] = sums->inner;
        cell.counters["sah_leaf"] = sums->leaf;
    }
}

Contest::Place Contest::compare(const Cell& cell, const std::vector<StageTime>& before,
                                double slower)
{
    if (race_ == Race::none || !tells(cell))
        return Place::in_the_race;
    const auto learn = [&](const std::vector<StageTime>& run) {
        for (const StageTime& time : run) {
            const double ns = static_cast<double>(time.elapsed_ns()) / slower;
            keep_least(key_of(time.stage, cell), ns);
            if (time.stage == "broad")
                keep_least(key_of_kind(cell), ns);
        }
    };
    learn(before);
    double own = std::numeric_limits<double>::infinity();
    for (const Sample& sample : cell.samples) {
        learn(sample.stages);
        own = std::min(own, raced_ns(race_, sample));
    }
    const double earlier = before.empty() ? own : raced_ns(race_, before);
    best_ns_ = best_ns_ == 0 ? own : std::min(best_ns_, own);
    const double limit = race_ == Race::memory ? own : far_behind * slower * best_ns_;
    return own <= limit       ? Place::in_the_race
           : earlier <= limit ? Place::slow_once
                              : Place::far_behind;
}

std::string Contest::why_not(const Cell& cell) const
{
    if (race_ == Race::none || race_ == Race::memory || best_ns_ == 0 || !can_judge(cell.collider))
        return "";
    double sum = 0;
    for (const std::string stage : stages)
        if (race_ == Race::whole || is_of_query(stage)) {
            const double known = least_of(key_of(stage, cell));
            sum +=
                known > 0 || stage != "broad" ? known : least_of(key_of_kind(cell)) / across_orders;
        }
    if (sum <= hopeless * best_ns_)
        return "";
    return "cannot win: its stages take at least " + duration_text(sum) +
           ", as other cells tell, and the best of all " + duration_text(best_ns_);
}

double Contest::value_of(const Cell& cell) const
{
    if (!tells(cell) || !can_judge(cell.collider))
        return std::numeric_limits<double>::quiet_NaN();
    if (race_ == Race::memory)
        return bytes_held(cell);
    std::vector<double> values;
    for (const Sample& sample : cell.samples)
        values.push_back(raced_ns(race_, sample));
    return quantile(std::move(values), 0.5);
}

void Contest::end_frame(std::span<const Cell> cells)
{
    if (race_ == Race::none)
        return;
    sums_.resize(cells.size(), 0);
    for (std::size_t k = 0; k < cells.size(); ++k)
        sums_[k] += value_of(cells[k]);
    // Another frame may take any number of times as long.
    least_.clear();
    best_ns_ = 0;
}

std::string Contest::why_lost(std::size_t k) const
{
    double best = std::numeric_limits<double>::infinity();
    for (const double sum : sums_)
        best = std::isnan(sum) ? best : std::min(best, sum);
    if (race_ == Race::none || !(sums_[k] > lost * best))
        return "";
    return "left behind: over the frames before, " + fixed(sums_[k] / best, 1) + " times the " +
           (race_ == Race::memory ? "memory" : "time") + " of the best";
}

}  // namespace bvhbench
