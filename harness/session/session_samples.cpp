// SPDX-License-Identifier: MIT
#include "harness/session/session_samples.h"

#include <chrono>

#include "harness/base/failure.h"

namespace bvhbench {
namespace {

/// Of fewer samples no statistic is made that drift could spoil, and compiling the calibration takes longer than they do.
constexpr int fewest_calibrated = 9;

}  // namespace

std::vector<Taken> session_samples(Session& session, std::span<const Timed> cells,
                                   const SamplingPlan& plan, int& order)
{
    const bool calibrates = plan.rules.until > 0 || plan.samples >= fewest_calibrated;
    const std::string failure = reason_of_failure([&] { session.empty_caches(plan.rules.cold); });
    if (!failure.empty())
        return std::vector<Taken>(cells.size(), Taken{{}, failure, Stopped::failure});
    struct Hot {  // what is run outside samples is not to be slowed down
        Session& session;
        ~Hot() { session.empty_caches(false); }
    } const hot{session};
    return take_samples(
        cells, plan, order,
        calibrates ? [&] { return session.calibrate(); } : std::function<std::int64_t()>(),
        session.turns());
}

std::int64_t host_ns(const std::function<void()>& work)
{
    using clock = std::chrono::steady_clock;
    const auto start = clock::now();
    work();
    return std::chrono::nanoseconds(clock::now() - start).count();
}

}  // namespace bvhbench
