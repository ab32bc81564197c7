// SPDX-License-Identifier: MIT
#include "scenes/motion.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include "scenes/rigid_fit.h"

namespace bvhbench {
namespace {

/// How far rounding may move a point of these.
double rounding_of(std::span<const Vector> points, double rounding)
{
    double largest = 0;
    for (const Vector a : points)
        largest = std::max({largest, std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
    constexpr double smallest = 0x1p-150;  // half of the least float above 0
    return std::sqrt(3.0) * std::max(rounding * largest, smallest);
}

bool is_rigid(std::span<const Vector> from, std::span<const Vector> to, double rounding)
{
    constexpr double slack = 1 + 1e-3;  // what is not of first order, and arithmetic in double
    const double each = slack * (rounding_of(from, rounding) + rounding_of(to, rounding));
    const RigidFit fit = fit_rigid(from, to);
    const std::vector<double> allowances = fit_allowances(from);
    for (std::size_t k = 0; k < from.size(); ++k)
        if (length(to[k] - fit(from[k])) > each * allowances[k])
            return false;
    return true;
}

}  // namespace

std::vector<Motion> object_motions(const Scene& scene, std::size_t from, std::size_t to,
                                   double rounding)
{
    assert(from < scene.frames.size() && to < scene.frames.size());
    const std::vector<Point>& old_points = scene.frames[from];
    const std::vector<Point>& new_points = scene.frames[to];
    std::vector<std::size_t> seen(old_points.size(), 0);  // by which object, from 1
    std::vector<Vector> before, after;
    std::vector<Motion> motions;
    for (const SceneObject& object : scene.objects) {
        before.clear();
        after.clear();
        bool is_unchanged = true;
        for (uint k = 0; k < object.face_count; ++k) {
            const Face face = scene.faces[object.first_face + k];
            for (const uint corner : {face.a, face.b, face.c}) {
                if (std::exchange(seen[corner], motions.size() + 1) == motions.size() + 1)
                    continue;
                before.push_back(vector_of(old_points[corner]));
                after.push_back(vector_of(new_points[corner]));
                is_unchanged = is_unchanged && std::memcmp(&old_points[corner], &new_points[corner],
                                                           sizeof(Point)) == 0;
            }
        }
        motions.push_back(is_unchanged                        ? Motion::unchanged
                          : is_rigid(before, after, rounding) ? Motion::rigid
                                                              : Motion::deforming);
    }
    return motions;
}

}  // namespace bvhbench
