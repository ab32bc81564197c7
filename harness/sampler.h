// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "harness/record.h"

namespace bvhbench {

/// One thing to sample.
struct Timed {
    std::string name;
    std::function<std::vector<StageTime>()> once;  ///< run it, wait, and say what its stages took
};

/// What came of it.
struct Taken {
    std::vector<Sample> samples;  ///< in the order taken, warm-up left out
    std::string failure;          ///< why it stopped early; empty if it did not
};

/// Sample each of `cells` `samples` times after `warm_up` times that do not count, all of them interleaved at
/// random, so that drift of the machine hits them alike. One that fails is not run again; the others go on.
///
/// Google Benchmark decides what runs when; its clock is the device's: the stages' spans. `order` counts the
/// run's samples and goes on from call to call. Throws Interrupted.
std::vector<Taken> take_samples(std::span<const Timed> cells, int samples, int warm_up, int& order);

}  // namespace bvhbench
