// SPDX-License-Identifier: MIT
//
// What two runs of one program differ in though nothing was changed: how fast the device was, and how that wavered.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "harness/record.h"

namespace bvhbench {

/// A cell's samples in two files, those of them that are compared, in the order taken.
struct SamplePair {
    std::vector<const Sample*> first, second;
};

/// Of the cells of a scene: the samples beside which the calibration took about as long in both files, within 5 % of the
/// time at which the most of both did. A machine has states, and which of them a run meets is chance. Where the files have
/// no calibration, the samples that statistics are made of. Each pair may be empty.
std::vector<SamplePair> at_like_speed(
    const std::vector<std::pair<const Cell*, const Cell*>>& cells);

/// The samples that statistics are made of.
std::vector<SamplePair> counted_pairs(
    const std::vector<std::pair<const Cell*, const Cell*>>& cells);

/// The logarithm of the ratio of a run's slowest eighth to its fastest, minus what chance alone gives; 0 for too few samples.
/// Samples are cut into eighths by their order; the speed of one is the median over its cells of their time in it, relative to
/// their median over the whole run.
double wavering(const std::vector<std::vector<const Sample*>>& cells);

/// What two runs that took turns had in common: of the cells of a scene, by how much the n-th samples in both files and those
/// beside them are slower than their cells' medians, the median of all of these, as the logarithm of a ratio.
std::vector<double> common_trend(const std::vector<SamplePair>& cells);

/// Whole times of samples in nanoseconds, or those of a stage.
std::vector<double> times_of(const std::vector<const Sample*>& samples,
                             std::string_view stage = {});

}  // namespace bvhbench
