// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "geometry/vectors.h"
#include "scenes/scene.h"

namespace bvhbench {

/// How an object goes from one frame to another.
enum class Motion {
    unchanged,  ///< every position is the same, bit for bit
    rigid,      ///< all positions are those of one turn and shift, but for rounding
    deforming,
};

/// For each object of `scene`, how the vertices its triangles name go from frame `from` to frame `to`.
///
/// An object is rigid when the best turn and shift leaves no vertex farther from its place than could be if both
/// frames were an exact rigid motion whose coordinates were then rounded once, by 2^-24 of the largest
/// coordinate of the object in that frame (the bound: `fit_allowances`). So whatever is rigid
/// is found to be, and what is deformed by more than some five roundings is not.
std::vector<Motion> object_motions(const Scene& scene, std::size_t from, std::size_t to);

/// The turn and shift that bring one set of points nearest to another, in the sum of squared distances.
struct RigidFit {
    std::array<Vector, 3> turn = {};  ///< rows of a rotation, never a reflection
    Vector from_centre = {}, to_centre = {};

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
