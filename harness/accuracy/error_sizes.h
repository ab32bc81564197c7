// SPDX-License-Identifier: MIT
//
// How large errors are: how deep triangles overlap whose contact was missed, and how far apart those of a false contact are.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "collide/pairs.h"
#include "harness/record/record.h"

namespace bvhbench {

/// Returns the value below which `share` of the sorted values are; 0 if there are none.
double value_at(std::span<const double> sorted, double share);

/// Sizes of the errors of a method: depths of missed contacts and distances of false ones.
class ErrorSizes {
public:
    /// Adds what two lists of contacts differ in, by the exact corners: at most `most` missed ones and as many false ones, spread over all.
    /// Sizes are shares of `unit`, or if that is 0 of the longest side of the box around both triangles. Uses all host cores.
    void add(const PairList& found, const PairList& right, std::span<const Point> points,
             std::span<const Face> faces, double unit, std::size_t most = SIZE_MAX);

    /// Writes the counters missed_depth_median, _99_percent and _most, and false_gap_ of the same; those of no errors are left out.
    void put(Cell& cell);

private:
    std::vector<double> depths_, gaps_;
};

}  // namespace bvhbench
