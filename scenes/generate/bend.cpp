// SPDX-License-Identifier: MIT
#include "scenes/generate/bend.h"

#include <algorithm>

#include "geometry/error.h"

namespace bvhbench {
namespace {

constexpr double reach = 1.0 / 32;

/// b of where `x` is between `low` and `high`; 0 where they are one.
double bump(double x, double low, double high)
{
    if (!(high > low))
        return 0;
    const double t = (x - low) / (high - low);
    return 4 * t * (1 - t);
}

float moved(float x, double by) { return static_cast<float>(double{x} + by); }

}  // namespace

Scene with_bend(Scene scene)
{
    if (scene.frames.size() != 1)
        throw BadUsage("scene '" + scene.name + "' has " + std::to_string(scene.frames.size()) +
                       " frames and needs no other");
    const std::vector<Point>& points = scene.frames.front();
    Aabb box = empty_box();
    for (const Point& point : points)
        box = merged(box, triangle_box(point, point, point));
    const double side = std::max({double{box.max_x} - box.min_x, double{box.max_y} - box.min_y,
                                  double{box.max_z} - box.min_z});
    std::vector<Point> bent;
    for (const Point& point : points) {
        const double x = bump(point.y, box.min_y, box.max_y);
        const double y = bump(point.z, box.min_z, box.max_z);
        const double z = bump(point.x, box.min_x, box.max_x);
        bent.push_back({moved(point.x, reach * side * x), moved(point.y, reach * side * y),
                        moved(point.z, reach * side * z)});
    }
    scene.frames.push_back(std::move(bent));
    scene.frame_labels.clear();
    scene.bend_of = scene.name;
    return scene;
}

}  // namespace bvhbench
