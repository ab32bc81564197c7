// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>

#include "harness/session/sampler.h"
#include "harness/session/session.h"

namespace bvhbench {

/// Samples on the session's device: with its calibration between them, where there are enough of them for it to tell
/// anything, and with its caches emptied before each if the plan says so. Throws as take_samples does.
std::vector<Taken> session_samples(Session& session, std::span<const Timed> cells,
                                   const SamplingPlan& plan, int& order);

/// What `work` takes, on the host's clock, in nanoseconds.
std::int64_t host_ns(const std::function<void()>& work);

}  // namespace bvhbench
