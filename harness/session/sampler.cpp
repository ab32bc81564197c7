// SPDX-License-Identifier: MIT
#include "harness/session/sampler.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "harness/base/failure.h"
#include "harness/base/test_hooks.h"
#include "harness/session/statistics.h"
#include "harness/session/stopping.h"

namespace bvhbench {
namespace {

/// What the calibration took, in the order of samples.
class Drift {
public:
    Drift(const SamplingPlan& plan, const std::function<std::int64_t()>& calibrate)
        : plan_(plan), calibrate_(plan.rules.calibrate_every > 0 ? calibrate : nullptr)
    {}

    /// Before the sample that will be called `order`; only if it is time again, unless it `must`.
    void look(int order, bool must = false)
    {
        if (!calibrate_ || (!must && order < next_))
            return;
        next_ = order + plan_.rules.calibrate_every;
        std::int64_t ns = 0;
        if (reason_of_failure([&] { ns = calibrate_(); }).empty()) {
            looks_.push_back({order, static_cast<double>(ns)});
        } else {  // samples are worth having without
            calibrate_ = nullptr;
            looks_.clear();
        }
    }

    /// Whether it took just now what it takes.
    bool is_steady() const { return looks_.empty() || !is_off(looks_.back().ns, median()); }

    /// Tell samples what it took around them.
    void mark(std::vector<Sample>& samples) const
    {
        if (looks_.size() < 2)
            return;
        const double usual = median();
        for (Sample& sample : samples) {
            const auto after =
                std::upper_bound(looks_.begin() + 1, looks_.end() - 1, sample.order,
                                 [](int order, const Look& look) { return order < look.order; });
            const double before_ns = (after - 1)->ns;
            sample.calibration_ns = std::llround((before_ns + after->ns) / 2);
            sample.drifted = is_off(before_ns, usual) || is_off(after->ns, usual);
        }
    }

private:
    struct Look {
        int order;
        double ns;
    };

    bool is_off(double ns, double usual) const
    {
        return std::fabs(ns / usual - 1) > plan_.rules.drift_limit;
    }

    double median() const
    {
        std::vector<double> all;
        for (const Look& look : looks_)
            all.push_back(look.ns);
        return quantile(std::move(all), 0.5);
    }

    const SamplingPlan& plan_;
    std::function<std::int64_t()> calibrate_;
    std::vector<Look> looks_;
    int next_ = 0;
};

/// One call of take_samples: rounds, until every cell has enough.
class Rounds {
public:
    Rounds(std::span<const Timed> cells, const SamplingPlan& plan, int& order,
           const std::function<std::int64_t()>& calibrate, Turns* turns)
        : cells_(cells)
        , plan_(plan)
        , order_(order)
        , drift_(plan, calibrate)
        , turns_(turns)
        , random_(static_cast<unsigned>(order))
        , taken_(cells.size())
        , rules_(cells.size(), StoppingRule(plan))
    {
        for (std::size_t i = 0; i < cells.size(); ++i)
            going_.push_back(i);
    }

    std::vector<Taken> run()
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
        for (Taken& taken : taken_)
            drift_.mark(taken.samples);
        return std::move(taken_);
    }

private:
    void look_in_turn()
    {
        const Turns::Turn turn(turns_);
        drift_.look(order_, true);
    }

    void take_round(bool counts)
    {
        const Turns::Turn turn(turns_);
        std::shuffle(going_.begin(), going_.end(), random_);
        for (const std::size_t i : going_) {
            if (counts)
                drift_.look(order_);
            take(i, counts);
        }
        std::erase_if(going_,
                      [&](std::size_t i) { return taken_[i].stopped != Stopped::not_sampled; });
    }

    void take(std::size_t i, bool counts)
    {
        Taken& taken = taken_[i];
        std::vector<StageTime> stages;
        const int order = order_++;
        taken.failure = reason_of_failure([&] { stages = cells_[i].once(); });
        if (!taken.failure.empty()) {
            taken.stopped = Stopped::failure;
            return;
        }
        if (!counts)
            return;
        slow_down(stages, slowed_by(cells_[i].name));
        rules_[i].add(whole_ns(stages), drift_.is_steady());
        taken.samples.push_back({order, std::move(stages)});
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
        taken.stopped = rules_[i].verdict(elapsed.count());
    }

    std::span<const Timed> cells_;
    const SamplingPlan& plan_;
    int& order_;
    Drift drift_;
    Turns* turns_;
    std::mt19937 random_;
    std::vector<Taken> taken_;
    std::vector<StoppingRule> rules_;
    std::vector<std::size_t> going_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace

std::vector<Taken> take_samples(std::span<const Timed> cells, const SamplingPlan& plan, int& order,
                                const std::function<std::int64_t()>& calibrate, Turns* turns)
{
    return Rounds(cells, plan, order, calibrate, turns).run();
}

}  // namespace bvhbench
