// SPDX-License-Identifier: MIT
#include "harness/measure/engine.h"

#include <optional>

#include "harness/base/failure.h"
#include "harness/session/session_samples.h"

namespace bvhbench {

void Engine::refuse(Subject& subject, Cell::Status status, std::string reason)
{
    session_.renew_queue();
    subject.cell.status = status;
    subject.cell.reason = std::move(reason);
    subject.cell.samples.clear();
}

void Engine::settle(Subject& subject, const std::function<void()>& work)
{
    if (std::string why = session_.watchdog().given_up(subject.number); !why.empty())
        return refuse(subject, Cell::Status::failed, std::move(why));
    const Watchdog::Hand hand(session_.watchdog(), subject.number);
    const std::int64_t compiled_ns = session_.programs().compile_ns();
    bool cannot_be = false;
    std::string failure = reason_of_failure(cannot_be, work);
    subject.cell.first.compile_ns = session_.programs().compile_ns() - compiled_ns;
    if (!failure.empty())
        refuse(subject, cannot_be ? Cell::Status::skipped : Cell::Status::failed,
               std::move(failure));
}

void Engine::sample(std::span<Subject> subjects)
{
    std::vector<Timed> timed;
    std::vector<Subject*> ready;
    for (Subject& one : subjects) {
        if (!one.is_ready())
            continue;
        ready.push_back(&one);
        const Cell& cell = one.cell;
        timed.push_back(
            {cell.collider.name.empty() ? cell.builder.name : cell.collider.name, [this, &one] {
                 std::optional<Watchdog::Hand> hand;
                 if (!one.number.empty())
                     hand.emplace(session_.watchdog(), one.number);
                 return one.once();
             }});
    }
    std::vector<Taken> taken = session_samples(session_, timed, plan_, order_);
    for (std::size_t i = 0; i < ready.size(); ++i) {
        Cell& cell = ready[i]->cell;
        cell.warm_up = plan_.warm_up;
        cell.samples = std::move(taken[i].samples);
        cell.sampling = {
            .stopped = taken[i].stopped, .until = plan_.rules.until, .cold = plan_.rules.cold};
        std::string failure = std::move(taken[i].failure);
        if (failure.empty() && ready[i]->judge_again)
            failure = reason_of_failure(ready[i]->judge_again);
        if (!failure.empty())
            refuse(*ready[i], Cell::Status::failed, std::move(failure));
    }
}

}  // namespace bvhbench
