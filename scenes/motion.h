// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "geometry/vectors.h"
#include "scenes/scene.h"

namespace bvhbench {

/// Motion of an object from one frame to another.
enum class Motion {
    unchanged,  ///< all positions are equal, bit for bit
    rigid,      ///< all positions follow one rotation and translation, up to rounding
    deforming,
};

/// Returns, for each object of `scene`, how the vertices of its triangles move from frame `from` to frame `to`.
///
/// An object is rigid if the best rotation and translation leaves every vertex within the distance that is possible if both
/// frames were an exact rigid motion with coordinates rounded once, by 2^-24 of the object's largest coordinate in that frame
/// (the bound: `fit_allowances`). Every rigid motion is therefore recognised, and a deformation of more than some five
/// roundings is not rigid.
std::vector<Motion> object_motions(const Scene& scene, std::size_t from, std::size_t to);

/// Rotation and translation that map one set of points to another with the smallest sum of squared distances.
struct RigidFit {
    std::array<Vector, 3> turn = {};  ///< rows of a rotation matrix, never a reflection
    Vector from_centre = {}, to_centre = {};

    Vector operator()(Vector point) const;
};

/// Computes the fit by the quaternion of Horn's closed form [Horn1987]. Point k of `from` corresponds to point k of `to`; there
/// is at least one point.
RigidFit fit_rigid(std::span<const Vector> from, std::span<const Vector> to);

/// Returns how much farther from its partner each point may be under the best fit than under the exact motion.
///
/// If a rigid motion maps every point of `from` to within 1 of its partner, then the best fit maps point i to within
///
///     2 + sum over k of r_ki * sum_j r_kj / sum_j r_kj^2
///
/// of its partner, to first order: 1 for the point itself, 1 for the mean of all points, which translates the fit, and for each
/// principal axis k through the centre the rotation that all points together can cause about it, at distance r_ki from it.
std::vector<double> fit_allowances(std::span<const Vector> from);

}  // namespace bvhbench
