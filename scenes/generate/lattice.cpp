// SPDX-License-Identifier: MIT
//
// Many small bodies: balls in a cubic lattice, each of which reaches into its six neighbours.
#include <cmath>

#include "scenes/generate/generators.h"
#include "scenes/generate/vector.h"

namespace bvhbench {
namespace {

constexpr double centres_apart = 1.9;  // of two neighbours, in radii
constexpr uint one_moves_of = 10;      // bodies
constexpr double whole_way = 3;        // from the first frame to the last, in radii

}  // namespace

Scene make_bodies(uint bodies, uint each, uint frames)
{
    Scene scene;
    scene.source = "generated";
    const Mesh ball = make_sphere(each);
    const auto side = static_cast<uint>(std::ceil(std::cbrt(bodies)));
    for (uint body = 0; body < bodies; ++body) {
        const auto base = static_cast<uint>(body * ball.points.size());
        scene.objects.push_back({"body " + std::to_string(body), body * each, each});
        for (const Face& face : ball.faces)
            scene.faces.push_back({face.a + base, face.b + base, face.c + base});
    }
    for (uint frame = 0; frame < frames; ++frame) {
        std::vector<Point>& points = scene.frames.emplace_back();
        points.reserve(std::size_t{bodies} * ball.points.size());
        for (uint body = 0; body < bodies; ++body) {
            const Vector place = {1.0 * (body % side), 1.0 * (body / side % side),
                                  1.0 * (body / side / side)};
            const double way = body % one_moves_of == 0 ? whole_way * frame / frames : 0;
            const Vector at = centres_apart * place + Vector{way, 0.5 * way, 0};
            for (const Point& point : ball.points)
                points.push_back(rounded(at + vector_of(point)));
        }
    }
    return scene;
}

}  // namespace bvhbench
