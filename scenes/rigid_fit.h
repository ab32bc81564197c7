// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "scenes/generate/vector.h"

namespace bvhbench {

/// The turn and shift that bring one set of points nearest to another, in the sum of squared distances.
struct RigidFit {
    double turn[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< a rotation, never a reflection
    Vector from_centre, to_centre;

    Vector operator()(Vector point) const;
};

/// By the quaternion of Horn's closed form ([Horn1987]). Point k of `from` belongs to point k of `to`; at least one.
RigidFit fit_rigid(std::span<const Vector> from, std::span<const Vector> to);

/// How much farther apart a fit may leave two points than the exact motion does.
///
/// If a rigid motion brings every point of `from` to within 1 of its partner, then the best fit brings point i to
/// within
///
///     2 + sum over k of r_ki * sum_j r_kj / sum_j r_kj^2
///
/// of it, to first order: 1 for the point, 1 for the mean of all, which shifts the fit, and for each principal
/// axis k through the centre what all points together can turn the fit about it, at distance r_ki from it.
std::vector<double> fit_allowances(std::span<const Vector> from);

}  // namespace bvhbench
