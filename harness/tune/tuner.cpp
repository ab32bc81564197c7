// SPDX-License-Identifier: MIT
#include "harness/tune/tuner.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "geometry/error.h"
#include "harness/base/failure.h"
#include "harness/base/table.h"
#include "harness/session/sampler.h"

namespace bvhbench {
namespace {

/// Returns the times of one stage in all samples, in nanoseconds; of all stages together if `stage` is empty or was part of another.
std::vector<double> times_of(const std::vector<Sample>& samples, std::string_view stage)
{
    std::vector<double> times;
    for (const Sample& sample : samples) {
        double ns = 0;
        for (const StageTime& time : sample.stages)
            if (time.stage == stage)
                ns += static_cast<double>(time.elapsed_ns());
        times.push_back(ns > 0 ? ns : whole_ns(sample.stages));
    }
    return times;
}

double median(const std::vector<double>& values) { return quantile(values, 0.5); }

/// Returns the standard error of a median, from the median absolute deviation, as for a normal distribution.
double standard_error(const std::vector<double>& values)
{
    const double middle = median(values);
    std::vector<double> distances;
    for (const double value : values)
        distances.push_back(std::fabs(value - middle));
    return 1.2533 * 1.4826 * median(distances) / std::sqrt(static_cast<double>(values.size()));
}

/// A value with its trial; the trial is null if it failed or was wrong.
struct Contender {
    TrialResult tried;
    std::unique_ptr<Trial> trial;
};

struct Search {
    const MakeTrial& make;
    const SearchOptions& options;
    const SearchNote& note;
    SearchResult result = {};
    int order = 0;
    std::string last_failure = {};  ///< of the last failed trial

    /// Searches the best value of one parameter. True if another value than the current one was kept.
    bool tune_parameter(const Parameter& parameter)
    {
        std::vector<Contender> all;
        const uint current = result.best.value(parameter, options.is_cpu);
        all.push_back(contender(parameter, current));
        if (all.front().trial == nullptr)
            throw Unavailable(std::string(parameter.name) + ": the value it has is " +
                              all.front().tried.detail);
        all.front().tried.verdict = TrialResult::Verdict::current;
        for (const uint value : parameter.candidates)
            if (value != current && parameter.refusal(value).empty())
                all.push_back(contender(parameter, value));
        const bool found = measured(all);
        for (Contender& one : all)
            result.tries.push_back(std::move(one.tried));
        result.searched.insert(&parameter);
        return found;
    }

    /// Compares whole runs with the start values and with the kept ones, which are dropped if they are not faster.
    void compare_whole(const Tuning& start)
    {
        if (result.kept.empty())
            return;
        note("comparing with what it began with", result);
        const std::unique_ptr<Trial> before = make(start), after = make(result.best);
        const auto times = sampled({before.get(), after.get()}, "");
        result.start_ns = median(times[0]);
        result.best_ns = median(times[1]);
        if (result.best_ns < result.start_ns && after->wrong().empty())
            return;
        result.best = start;
        result.kept.clear();
    }

    Contender contender(const Parameter& parameter, uint value)
    {
        note(std::string(parameter.name) + " = " + std::to_string(value), result);
        Contender one{{.parameter = &parameter, .value = value}, nullptr};
        Tuning tuning = result.best;
        tuning.set(parameter, value);
        const std::string failure = reason_of_failure([&] {
            one.trial = make(tuning);
            if (const std::string why = one.trial->wrong(); !why.empty())
                reject(one, TrialResult::Verdict::wrong, why);
        });
        if (!failure.empty())
            reject(one, TrialResult::Verdict::impossible, failure);
        return one;
    }

    static void reject(Contender& one, TrialResult::Verdict verdict, const std::string& why)
    {
        one.tried.verdict = verdict;
        one.tried.detail = why.substr(0, why.find('\n'));  // without the lines of a compiler's log
        one.tried.median_ns = one.tried.ratio = 0;
        one.trial.reset();
    }

    /// Samples all contenders that can run, and keeps the fastest if it is faster than the first one twice.
    bool measured(std::vector<Contender>& all)
    {
        std::vector<Trial*> trials;
        for (const Contender& one : all)
            trials.push_back(one.trial.get());
        const auto times = sampled(trials, all.front().tried.parameter->stage);
        Contender* best = nullptr;
        for (std::size_t k = 0; k < all.size(); ++k) {
            Contender& one = all[k];
            if (one.trial == nullptr)
                continue;
            if (times[k].empty()) {
                reject(one, TrialResult::Verdict::impossible, last_failure);
                continue;
            }
            one.tried.median_ns = median(times[k]);
            one.tried.ratio = one.tried.median_ns / median(times.front());
            if (k > 0 && is_faster(times[k], times.front()) &&
                (best == nullptr || one.tried.median_ns < best->tried.median_ns))
                best = &one;
        }
        return best != nullptr && is_confirmed(*best, all.front());
    }

    /// The best of several is partly luck: it must be faster a second time, and its answer after the samples must be right.
    bool is_confirmed(Contender& best, Contender& current)
    {
        const Parameter& parameter = *best.tried.parameter;
        const auto times = sampled({current.trial.get(), best.trial.get()}, parameter.stage);
        if (const std::string why = best.trial->wrong(); !why.empty()) {
            reject(best, TrialResult::Verdict::wrong, why);
            return false;
        }
        best.tried.verdict = TrialResult::Verdict::not_again;
        if (times[0].empty() || times[1].empty() || !is_faster(times[1], times[0]))
            return false;
        best.tried.verdict = TrialResult::Verdict::better;
        best.tried.median_ns = median(times[1]);
        best.tried.ratio = best.tried.median_ns / median(times[0]);
        result.best.set(parameter, best.tried.value);
        std::erase_if(result.kept,
                      [&](const TrialResult& one) { return one.parameter == &parameter; });
        result.kept.push_back(best.tried);
        return true;
    }

    /// Returns the times of each trial, sampled interleaved; empty for a null one and for one that failed.
    std::vector<std::vector<double>> sampled(const std::vector<Trial*>& trials,
                                             std::string_view stage)
    {
        std::vector<std::vector<double>> times(trials.size());
        std::vector<std::vector<double>*> places;
        std::vector<CellToSample> timed;
        for (std::size_t k = 0; k < trials.size(); ++k)
            if (Trial* trial = trials[k]; trial != nullptr) {
                timed.push_back({"trial", [trial] { return trial->once(); }});
                places.push_back(&times[k]);
            }
        auto place = places.begin();
        const SamplingPlan plan{.samples = options.samples, .warm_up = options.warm_up};
        for (const CellSamples& taken : take_samples(timed, plan, order)) {
            if (taken.failure.empty())
                **place = times_of(taken.samples, stage);
            else
                last_failure = taken.failure;
            ++place;
        }
        return times;
    }
};

/// By verdict; for `wrong` and `impossible`, the detail follows.
constexpr const char* verdict_names[] = {"current",          "better, kept", "not better",
                                         "not better again", "wrong: ",      "impossible: "};

}  // namespace

bool is_faster(const std::vector<double>& times, const std::vector<double>& than)
{
    const double gain = median(than) - median(times);
    const double noise = std::hypot(standard_error(times), standard_error(than));
    return gain > 3 * noise && gain > 0.01 * median(than);
}

SearchResult search(const MakeTrial& make, const Tuning& start,
                    const std::function<bool(const Parameter&)>& wanted,
                    const SearchOptions& options, const SearchNote& note)
{
    Search turn{make, options, note};
    turn.result.best = start;
    std::vector<const Parameter*> parameters;
    {
        const std::unique_ptr<Trial> first = make(start);
        if (const std::string why = first->wrong(); !why.empty())
            throw Unavailable("the answer is wrong before anything is tuned: " + why);
        std::ranges::copy_if(first->asked(), std::back_inserter(parameters),
                             [&](const Parameter* one) { return wanted(*one); });
    }
    std::ranges::sort(parameters, {}, [](const Parameter* one) { return one->name; });
    for (const Parameter* parameter : parameters)
        turn.result.best.unset(*parameter);
    const Tuning defaults = turn.result.best;
    for (int round = 0; round < options.rounds; ++round) {
        int kept = 0;
        for (const Parameter* parameter : parameters)
            kept += turn.tune_parameter(*parameter) ? 1 : 0;
        if (kept == 0)
            break;
    }
    turn.compare_whole(defaults);
    return std::move(turn.result);
}

std::string search_report(const SearchResult& result)
{
    Table table({"<parameter", "value", "<stage", "median", "to current", "<verdict"});
    for (const TrialResult& tried : result.tries)
        table.row({std::string(tried.parameter->name), std::to_string(tried.value),
                   tried.parameter->stage.empty() ? "all" : std::string(tried.parameter->stage),
                   tried.median_ns > 0 ? duration_text(tried.median_ns) : "",
                   tried.median_ns > 0 ? fixed(tried.ratio, 3) : "",
                   verdict_names[static_cast<std::size_t>(tried.verdict)] + tried.detail});
    std::string text = table.text();
    if (result.best_ns > 0)
        text += "whole run: " + duration_text(result.start_ns) + " before, " +
                duration_text(result.best_ns) + " after, ratio " +
                fixed(result.best_ns / result.start_ns, 3) +
                (result.kept.empty() ? ": not faster, nothing is kept\n" : "\n");
    return text;
}

}  // namespace bvhbench
