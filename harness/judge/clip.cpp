// SPDX-License-Identifier: MIT
#include "harness/judge/clip.h"

#include <algorithm>
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

void add(Polygon& polygon, const Corner& corner)
{
    if (polygon.count < Polygon::most_corners)
        polygon.corners[polygon.count++] = corner;
}

/// Into `kept` what lies on the side of `plane` where sign * coordinate >= sign * plane
/// (Sutherland and Hodgman 1974).
void cut(const Polygon& polygon, int axis, double plane, double sign, Polygon& kept)
{
    kept.count = 0;
    const Corner* from = &polygon.corners[polygon.count - 1];
    bool was_inside = sign * (from->axis[axis] - plane) >= 0;
    for (int i = 0; i < polygon.count; ++i) {
        const Corner* to = &polygon.corners[i];
        const bool is_inside = sign * (to->axis[axis] - plane) >= 0;
        if (is_inside != was_inside)
            add(kept, on_plane(*from, *to, axis, plane));
        if (is_inside)
            add(kept, *to);
        from = to;
        was_inside = is_inside;
    }
}

/// Set the box of a polygon that has corners.
void enclose(Polygon& polygon)
{
    for (int k = 0; k < 3; ++k) {
        double low = polygon.corners[0].axis[k], high = low;
        for (int i = 1; i < polygon.count; ++i) {
            low = std::min(low, polygon.corners[i].axis[k]);
            high = std::max(high, polygon.corners[i].axis[k]);
        }
        polygon.low[k] = low;
        polygon.high[k] = high;
    }
}

}  // namespace

Polygon polygon_of(std::span<const Point> points, Face face)
{
    Polygon polygon;
    for (const uint corner : {face.a, face.b, face.c})
        add(polygon, corner_of(points[corner]));
    enclose(polygon);
    return polygon;
}

void clip(const Polygon& polygon, const Aabb& box, Polygon& left)
{
    const double low[3] = {box.min_x, box.min_y, box.min_z};
    const double high[3] = {box.max_x, box.max_y, box.max_z};
    Polygon other;
    const Polygon* now = &polygon;
    const auto keep = [&](int axis, double plane, double sign) {
        Polygon& next = now == &left ? other : left;
        cut(*now, axis, plane, sign, next);
        now = &next;
    };
    for (int axis = 0; axis < 3; ++axis) {
        if (now->count > 0 && polygon.low[axis] < low[axis])
            keep(axis, low[axis], 1);
        if (now->count > 0 && polygon.high[axis] > high[axis])
            keep(axis, high[axis], -1);
    }
    if (now != &left) {
        left.count = now->count;
        std::copy_n(now->corners, now->count, left.corners);
    }
    if (left.count > 0)
        enclose(left);
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
