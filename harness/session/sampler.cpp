// SPDX-License-Identifier: MIT
#include "harness/session/sampler.h"

#include <algorithm>
#include <chrono>
#include <random>

#include "harness/base/failure.h"
#include "harness/base/test_hooks.h"
#include "harness/session/drift.h"
#include "harness/session/race.h"
#include "harness/session/stopping_rule.h"

namespace bvhbench {
namespace {

/// One call of take_samples: takes rounds until every cell has enough samples.
class Rounds {
public:
    Rounds(std::span<const CellToSample> cells, const SamplingPlan& plan, int& order,
           const std::function<std::int64_t()>& calibrate, Turns* turns, OtherProcesses* others)
        : cells_(cells)
        , plan_(plan)
        , order_(order)
        , drift_(plan, calibrate)
        , turns_(turns)
        , others_(others)
        , random_(static_cast<unsigned>(order))
        , taken_(cells.size())
        , rules_(cells.size(), StoppingRule(plan))
        , runners_(cells.size())
    {
        for (std::size_t i = 0; i < cells.size(); ++i) {
            runners_[i].bytes = plan.rules.race == Race::memory ? cells[i].bytes : 0;
            for (const Sample& sample : cells[i].earlier) {
                rules_[i].add(whole_ns(sample.stages), true);
                runners_[i].least = std::min(runners_[i].least, raced_ns(plan.rules.race, sample));
                taken_[i].samples.push_back(sample);
            }
            if (!cells[i].earlier.empty())
                taken_[i].stopped = rules_[i].verdict(0);
            if (taken_[i].stopped == Stopped::not_sampled)
                going_.push_back(i);
        }
    }

    std::vector<CellSamples> run()
    {
        if (turns_ != nullptr)
            turns_->meet();
        for (int round = 0; round < plan_.warm_up && !going_.empty(); ++round)
            take_round(false);
        start_ = std::chrono::steady_clock::now();
        look_in_turn();
        while (!going_.empty())
            take_round(true);
        look_in_turn();
        if (turns_ != nullptr)
            turns_->part();
        for (CellSamples& taken : taken_)
            drift_.mark(taken.samples);
        return std::move(taken_);
    }

private:
    void look_in_turn()
    {
        const Turns::Turn turn(turns_);
        drift_.calibrate_if_due(order_, true);
    }

    void take_round(bool counts)
    {
        const Turns::Turn turn(turns_);
        if (others_ != nullptr)
            others_->look();
        std::shuffle(going_.begin(), going_.end(), random_);
        for (const std::size_t i : going_) {
            if (counts)
                drift_.calibrate_if_due(order_);
            take(i, counts);
        }
        stop_beaten();
        if (plan_.after_round)
            plan_.after_round(++rounds_);
    }

    /// Marks the cells that another one beats, and removes all that have stopped.
    void stop_beaten()
    {
        const std::size_t best =
            plan_.rules.race == Race::none ? runners_.size() : best_of(runners_);
        if (best < runners_.size())
            for (const std::size_t i : going_)
                if (taken_[i].stopped == Stopped::not_sampled &&
                    is_beaten(runners_[i], runners_[best]))
                    taken_[i].stopped = Stopped::beaten;
        std::erase_if(going_,
                      [&](std::size_t i) { return taken_[i].stopped != Stopped::not_sampled; });
    }

    void take(std::size_t i, bool counts)
    {
        CellSamples& taken = taken_[i];
        std::vector<StageTime> stages;
        const int order = order_++;
        bool is_dropped = false;
        taken.failure = reason_of_failure([&] {
            try {
                stages = cells_[i].once();
            } catch (const BadClock& error) {
                is_dropped = true;
                if (counts)
                    drop(taken, error);
            }
        });
        if (!taken.failure.empty()) {
            taken.stopped = Stopped::failure;
            runners_[i].values.clear();
            return;
        }
        if (!counts || is_dropped)
            return;
        slow_down(stages, cells_[i].name);
        rules_[i].add(whole_ns(stages), drift_.is_steady());
        Sample& sample = taken.samples.emplace_back(Sample{order, std::move(stages)});
        if (cells_[i].wall_ns)
            sample.wall_ns = cells_[i].wall_ns();
        runners_[i].values.push_back(raced_ns(plan_.rules.race, sample));
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
        taken.stopped = rules_[i].verdict(elapsed.count());
    }

    /// Counts a dropped sample. Throws Unavailable if there are too many.
    static void drop(CellSamples& taken, const BadClock& error)
    {
        const auto all = static_cast<std::size_t>(++taken.dropped) + taken.samples.size();
        if (taken.dropped > 1 && 10 * static_cast<std::size_t>(taken.dropped) > all)
            throw Unavailable(std::to_string(taken.dropped) + " of " + std::to_string(all) +
                              " samples had impossible times: " + clock_sentence(error));
    }

    std::span<const CellToSample> cells_;
    const SamplingPlan& plan_;
    int& order_;
    Drift drift_;
    Turns* turns_;
    OtherProcesses* others_;
    std::mt19937 random_;
    std::vector<CellSamples> taken_;
    std::vector<StoppingRule> rules_;
    std::vector<Runner> runners_;
    std::vector<std::size_t> going_;
    int rounds_ = 0;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace

std::string clock_sentence(const BadClock& error)
{
    return error.what() + std::string(error.of_device ? "; --clock host takes the host's" : "");
}

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

std::vector<CellSamples> take_samples(std::span<const CellToSample> cells, const SamplingPlan& plan,
                                      int& order, const std::function<std::int64_t()>& calibrate,
                                      Turns* turns, OtherProcesses* others)
{
    return Rounds(cells, plan, order, calibrate, turns, others).run();
}

}  // namespace bvhbench
