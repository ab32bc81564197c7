// SPDX-License-Identifier: MIT
//
// Two spheres with vertices that are no places. A scene that is loaded never has any: `finished` refuses it.
#include <limits>

#include "scenes/stress/stress_scene.h"

namespace bvhbench {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

StressScene with(const StressSize& size, std::initializer_list<Point> places)
{
    StressScene scene = crossed_spheres(size.triangles(), size.seed);
    std::size_t at = scene.mesh.points.size() / 3;
    for (const Point& place : places) {
        scene.mesh.points[at] = place;
        at += 7;
    }
    return scene;
}

}  // namespace

std::vector<StressCase> not_finite_cases(const StressSize& size)
{
    return {{"one NaN",
             [=] {
                 return with(size, {{nan, nan, nan}});
             }},
            {"one NaN coordinate",
             [=] {
                 return with(size, {{0, nan, 0}});
             }},
            {"one infinite",
             [=] {
                 return with(size, {{infinity, infinity, infinity}});
             }},
            {"infinite both ways", [=] {
                 return with(size, {{infinity, 0, 0}, {-infinity, 0, 0}, {0, infinity, -infinity}});
             }}};
}

}  // namespace bvhbench
