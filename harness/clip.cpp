// SPDX-License-Identifier: MIT
#include "harness/clip.h"

#include <cmath>

namespace bvhbench {
namespace {

using Corner = Polygon::Corner;

Corner corner_of(Point point) { return {{point.x, point.y, point.z}}; }

/// Where the edge meets the plane: on it exactly, so that the next cut of the same plane changes nothing.
Corner on_plane(const Corner& a, const Corner& b, int axis, double plane)
{
    const double t = (plane - a.axis[axis]) / (b.axis[axis] - a.axis[axis]);
    Corner corner;
    for (int k = 0; k < 3; ++k)
        corner.axis[k] = a.axis[k] + t * (b.axis[k] - a.axis[k]);
    corner.axis[axis] = plane;
    return corner;
}

/// What lies on the side of `plane` where sign * coordinate >= sign * plane (Sutherland and Hodgman 1974).
Polygon cut(const Polygon& polygon, int axis, double plane, double sign)
{
    const auto is_inside = [&](const Corner& corner) {
        return sign * (corner.axis[axis] - plane) >= 0;
    };
    Polygon kept;
    for (int i = 0; i < polygon.count; ++i) {
        const Corner& from = polygon.corners[i];
        const Corner& to = polygon.corners[i + 1 < polygon.count ? i + 1 : 0];
        if (is_inside(from))
            kept.corners[kept.count++] = from;
        if (is_inside(from) != is_inside(to) && kept.count < 9)
            kept.corners[kept.count++] = on_plane(from, to, axis, plane);
    }
    return kept;
}

}  // namespace

Polygon polygon_of(std::span<const Point> points, Face face)
{
    Polygon polygon;
    polygon.corners[0] = corner_of(points[face.a]);
    polygon.corners[1] = corner_of(points[face.b]);
    polygon.corners[2] = corner_of(points[face.c]);
    polygon.count = 3;
    return polygon;
}

Polygon clipped(const Polygon& polygon, const Aabb& box)
{
    const double low[3] = {box.min_x, box.min_y, box.min_z};
    const double high[3] = {box.max_x, box.max_y, box.max_z};
    Polygon left = polygon;
    for (int axis = 0; axis < 3 && left.count > 0; ++axis)
        left = cut(cut(left, axis, low[axis], 1), axis, high[axis], -1);
    return left;
}

double area(const Polygon& polygon)
{
    // Twice the area as a vector: what triangles of a fan from the first corner add up to.
    double x = 0, y = 0, z = 0;
    const double* o = polygon.corners[0].axis;
    for (int i = 1; i + 1 < polygon.count; ++i) {
        const double* a = polygon.corners[i].axis;
        const double* b = polygon.corners[i + 1].axis;
        const double u[3] = {a[0] - o[0], a[1] - o[1], a[2] - o[2]};
        const double v[3] = {b[0] - o[0], b[1] - o[1], b[2] - o[2]};
        x += u[1] * v[2] - u[2] * v[1];
        y += u[2] * v[0] - u[0] * v[2];
        z += u[0] * v[1] - u[1] * v[0];
    }
    return 0.5 * std::sqrt(x * x + y * y + z * z);
}

}  // namespace bvhbench
