// SPDX-License-Identifier: MIT
#include "harness/measure/engine.h"

#include <algorithm>
#include <iterator>

#include "harness/base/failure.h"
#include "harness/session/race.h"
#include "harness/session/sampler.h"
#include "process/watchdog.h"

namespace bvhbench {
namespace {

/// Fewer samples than this run without calibration: compiling it takes longer than they do, and drift matters little.
constexpr int fewest_calibrated = 9;

/// Samples on the session's device, with such caches. Runs the calibration between samples if there are enough of them. Throws as
/// take_samples does.
std::vector<CellSamples> session_samples(Session& session, std::span<const CellToSample> cells,
                                         const SamplingPlan& plan, Caches caches, int& order)
{
    const std::string failure = reason_of_failure([&] { session.set_caches(caches); });
    if (!failure.empty())
        return std::vector<CellSamples>(cells.size(), CellSamples{{}, failure, Stopped::failure});
    struct Hot {  // work outside the samples runs with warm caches
        Session& session;
        ~Hot() { session.set_caches(Caches::hot); }
    } const hot{session};
    std::function<std::int64_t()> calibrate;
    if (plan.rules.until > 0 || plan.samples >= fewest_calibrated)
        calibrate = [&] { return session.calibrate(); };
    return take_samples(cells, plan, order, calibrate, session.turns(), &session.other_processes());
}

}  // namespace

std::int64_t host_ns(const std::function<void()>& work)
{
    using clock = std::chrono::steady_clock;
    const auto start = clock::now();
    work();
    const std::int64_t ns = std::chrono::nanoseconds(clock::now() - start).count();
    if (ns < 0)
        throw BadClock(false, "the host's clock went back");
    return ns;
}

void Engine::refuse(Cell& cell, Cell::Status status, std::string reason)
{
    session_.renew_queue();
    cell.status = status;
    cell.reason = std::move(reason);
    cell.samples.clear();
}

void Engine::prepare(Measurement& measurement, const std::function<void()>& work)
{
    if (std::string why = watchdog::given_up(measurement.number); !why.empty())
        return refuse(measurement.cell, Cell::Status::failed, std::move(why));
    if (const auto& is_wanted = session_.other_sampler.is_wanted;
        is_wanted && !is_wanted(measurement.cell))
        return refuse(measurement.cell, Cell::Status::skipped, "not wanted");
    const watchdog::CellScope scope(measurement.number);
    measurement.cell.warm_up = plan_.warm_up;
    const std::int64_t compiled_ns = session_.programs().compile_ns();
    bool cannot_be = false;
    std::string failure = reason_of_failure(work, &cannot_be);
    measurement.cell.first.compile_ns = session_.programs().compile_ns() - compiled_ns;
    if (!failure.empty())
        refuse(measurement.cell, cannot_be ? Cell::Status::skipped : Cell::Status::failed,
               std::move(failure));
}

bool Engine::sample_first(Measurement& measurement, Contest& contest)
{
    if (plan_.rules.race == Race::none || !measurement.is_ready())
        return false;
    Cell& cell = measurement.cell;
    Contest::Place place = Contest::Place::in_the_race;
    do {
        const int order = order_++;
        std::vector<StageTime> stages = run_once(measurement);
        if (cell.status != Cell::Status::measured)
            return false;
        cell.samples.push_back(
            {.order = order, .stages = std::move(stages), .wall_ns = session_.queue().wall_ns()});
        place = contest.compare(cell, measurement.stages_before, slower_now());
    } while (place == Contest::Place::slow_once && cell.samples.size() < 2);
    if (place != Contest::Place::far_behind) {
        const double own = raced_ns(plan_.rules.race, cell.samples.back());
        if (own > 0 && (ahead_ == nullptr || own < ahead_ns_)) {
            ahead_ = &measurement;
            ahead_ns_ = own;
        }
        return false;
    }
    measurement.once = {};
    cell.sampling = facts_of(Stopped::beaten, plan_.rules.caches.front());
    return true;
}

/// Runs a cell once and returns its stages. If that fails, refuses the cell and returns nothing.
std::vector<StageTime> Engine::run_once(Measurement& measurement)
{
    const watchdog::CellScope scope(measurement.number);
    std::vector<StageTime> stages;
    std::string failure = reason_of_failure([&] {
        session_.set_caches(plan_.rules.caches.front());
        try {
            stages = session_.timed(measurement.once);
        } catch (const BadClock&) {  // once may be chance
            stages = session_.timed(measurement.once);
        }
    });
    session_.set_caches(Caches::hot);
    if (!failure.empty())
        refuse(measurement.cell, Cell::Status::failed, std::move(failure));
    return stages;
}

/// Returns how many times its least time the best so far takes now; at least 1.
double Engine::slower_now()
{
    if (ahead_ == nullptr || !ahead_->is_ready() || plan_.rules.race == Race::memory)
        return 1;
    Sample sample{.stages = run_once(*ahead_)};
    sample.wall_ns = session_.queue().wall_ns();
    const double now = raced_ns(plan_.rules.race, sample);
    if (!ahead_->is_ready()) {
        ahead_ = nullptr;
        return 1;
    }
    ahead_ns_ = std::min(ahead_ns_, now);
    return ahead_ns_ > 0 ? now / ahead_ns_ : 1;
}

SamplingFacts Engine::facts_of(Stopped stopped, Caches caches) const
{
    const SamplingRules& rules = plan_.rules;
    return {.stopped = stopped, .until = rules.until, .race = rules.race, .caches = caches};
}

/// Runs a cell once between its copies, which are stages on the host.
std::vector<StageTime> Engine::from_host(Measurement& measurement)
{
    Queue& queue = session_.queue();
    std::vector<StageTime> stages;
    wall_ns_ = host_ns([&] {
        if (measurement.upload)
            queue.on_host("upload", measurement.upload);
        stages = measurement.once();
        if (!measurement.read_back)
            return;
        queue.on_host("read_back", measurement.read_back);
        std::ranges::move(queue.finish(), std::back_inserter(stages));
    });
    return stages;
}

/// Notes that `rounds` have been sampled in `sampling_s`, after `before_s` of preparation. All rounds take as long as the average.
void Engine::tell(int rounds, double before_s, double sampling_s) const
{
    const bool is_fixed = plan_.rules.until == 0;
    const int most = plan_.warm_up + (is_fixed ? plan_.samples : plan_.rules.max_samples);
    double all_s = sampling_s * most / rounds;
    if (!is_fixed)
        all_s = std::max(sampling_s, std::min(all_s, plan_.rules.time_budget_s));
    note_("sample " + std::to_string(rounds) + (is_fixed ? " of " : " of at most ") +
              std::to_string(most),
          (before_s + sampling_s) / (before_s + all_s));
}

std::vector<Cell> Engine::sample(std::span<Measurement> measurements)
{
    const std::vector<Caches>& kinds = plan_.rules.caches;
    std::vector<std::vector<Cell>> sampled(kinds.size(), std::vector<Cell>(measurements.size()));
    const auto& other_sampler = session_.other_sampler.sample;
    if (other_sampler)
        other_sampler(measurements);
    for (std::size_t kind = 0; kind < kinds.size() && !other_sampler; ++kind)
        sample(measurements, kinds[kind], sampled[kind]);
    std::vector<Cell> cells;
    for (std::size_t i = 0; i < measurements.size(); ++i) {
        Measurement& one = measurements[i];
        const bool was_sampled = one.is_ready() && !other_sampler;
        if (was_sampled && one.judge_again && one.cell.sampling.stopped != Stopped::beaten)
            if (std::string failure = reason_of_failure(one.judge_again); !failure.empty())
                refuse(one.cell, Cell::Status::failed, std::move(failure));
        for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
            Cell& cell = cells.emplace_back(one.cell);
            if (!was_sampled || cell.status != Cell::Status::measured)
                continue;
            cell.samples = std::move(sampled[kind][i].samples);
            cell.sampling = sampled[kind][i].sampling;
            cell.counters.merge(sampled[kind][i].counters);
            cell.left_out.merge(sampled[kind][i].left_out);
            if (kinds[kind] == Caches::host && !one.no_copies.empty()) {
                cell.status = Cell::Status::skipped;
                cell.reason = one.no_copies;
            }
        }
    }
    return cells;
}

/// Samples with caches of one kind, and writes samples and how they were taken to `cells`.
void Engine::sample(std::span<Measurement> measurements, Caches caches, std::span<Cell> cells)
{
    const double before_s = seconds_since(start_);
    if (note_)
        plan_.after_round = [this, before_s](int rounds) {
            tell(rounds, before_s, seconds_since(start_) - before_s);
        };
    std::vector<CellToSample> timed;
    std::vector<std::size_t> ready;
    const bool on_host = caches == Caches::host;
    for (std::size_t i = 0; i < measurements.size(); ++i) {
        Measurement& one = measurements[i];
        if (!one.is_ready() || (on_host && !one.no_copies.empty()))
            continue;
        ready.push_back(i);
        const Cell& cell = one.cell;
        timed.push_back(
            {cell.collider.name.empty() ? cell.builder.name : cell.collider.name,
             [this, &one, on_host] {
                 const watchdog::CellScope scope(one.number);
                 return session_.timed([&] { return on_host ? from_host(one) : one.once(); });
             },
             cell.samples, bytes_held(cell),
             [this, on_host] { return on_host ? wall_ns_ : session_.queue().wall_ns(); }});
    }
    std::vector<CellSamples> taken = session_samples(session_, timed, plan_, caches, order_);
    for (std::size_t k = 0; k < ready.size(); ++k) {
        Measurement& one = measurements[ready[k]];
        Cell& cell = cells[ready[k]];
        cell.samples = std::move(taken[k].samples);
        cell.sampling = one.cell.sampling = facts_of(taken[k].stopped, caches);
        cell.sampling.dropped = taken[k].dropped;
        if (!taken[k].failure.empty())
            refuse(one.cell, Cell::Status::failed, std::move(taken[k].failure));
        else if (plan_.rules.energy_s > 0 && caches == Caches::hot &&
                 taken[k].stopped != Stopped::beaten)
            count_joules(one, cell);
    }
}

}  // namespace bvhbench
