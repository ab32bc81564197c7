// SPDX-License-Identifier: MIT
//
// The race between cells of one scene or frame: which of them need no more samples because another cell is better. It answers
// "which is the fastest" with few samples (docs/races.md).
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "device/queue.h"
#include "harness/choice/sampling.h"
#include "harness/record/record.h"

namespace bvhbench {

/// A cell is far behind if its least value is more than this many times the best cell's median. It then needs one sample only.
constexpr double far_behind = 3;

/// Samples of each of two cells from which their intervals are compared.
constexpr std::size_t fewest_compared = 3;

/// What is known of one cell in a race.
struct Runner {
    std::vector<double> values;  ///< what the race is for, of each sample, in nanoseconds
    double bytes = 0;            ///< bytes held, compared first; 0 unless the race is for memory
    double least = HUGE_VAL;     ///< the least value of samples that were not interleaved
};

/// Two order statistics around a median.
struct MedianInterval {
    double low, high;
};

/// Returns the k-th smallest and the k-th largest of `values`, where k is the largest rank for which the interval holds the true
/// median with a probability of at least 95 %; k is 1 if no rank does, which is so for fewer than 6 values. `values` must not be
/// empty. No distribution is assumed [David2003, Section 7.1].
MedianInterval median_interval(std::vector<double> values);

/// True if `own` needs no more samples because of `best`: it holds more bytes, or it is far behind, or its interval lies above
/// the other's and even its least value above the other's median. Without a value on both sides, only bytes are compared.
bool is_beaten(const Runner& own, const Runner& best);

/// Returns the index of the best cell: fewest bytes, then the least median. Cells without values are left out; `cells.size()` if
/// none has any.
std::size_t best_of(std::span<const Runner> cells);

/// True for stages that follow the tree of a frame.
bool is_of_query(std::string_view stage);

/// Returns what a race for `race` compares of one sample, in nanoseconds: of the stages, or of `wall_ns` of the wall clock if that is
/// not 0. A query by the wall clock is what the stages of the tree leave of it.
double raced_ns(Race race, const std::vector<StageTime>& stages, std::int64_t wall_ns = 0);

/// The same of a sample. It is by the wall clock if the run has methods from outside, which say themselves what their stages take.
double raced_ns(Race race, const Sample& sample);

}  // namespace bvhbench
