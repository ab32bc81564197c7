// SPDX-License-Identifier: MIT
#include "scenes/generate/outlier.h"

#include <algorithm>
#include <cmath>

#include "geometry/error.h"

namespace bvhbench {
namespace {

struct Vector {
    double x, y, z;
    double length() const { return std::sqrt(x * x + y * y + z * z); }
};

Vector from_to(Point a, Point b)
{
    return {static_cast<double>(b.x) - a.x, static_cast<double>(b.y) - a.y,
            static_cast<double>(b.z) - a.z};
}

Vector cross(Vector a, Vector b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double box_diagonal(const std::vector<Point>& points, const std::vector<Face>& faces)
{
    Aabb box = empty_box();
    for (const Face& face : faces)
        box = merged(box, triangle_box(points[face.a], points[face.b], points[face.c]));
    return from_to({box.min_x, box.min_y, box.min_z}, {box.max_x, box.max_y, box.max_z}).length();
}

Point moved(Point point, Vector by)
{
    return {static_cast<float>(point.x + by.x), static_cast<float>(point.y + by.y),
            static_cast<float>(point.z + by.z)};
}

}  // namespace

Scene with_outlier(Scene scene, uint triangle, double diameters)
{
    if (triangle >= scene.triangle_count())
        throw BadUsage("scene '" + scene.name + "' has no triangle " + std::to_string(triangle) +
                       " to move, but " + std::to_string(scene.triangle_count()));
    std::size_t place = triangle;
    if (!scene.file_faces.empty())
        place = static_cast<std::size_t>(std::ranges::find(scene.file_faces, triangle) -
                                         scene.file_faces.begin());
    const Face face = scene.faces[place];
    const auto first = static_cast<uint>(scene.frames.front().size());
    for (std::vector<Point>& points : scene.frames) {
        const Point a = points[face.a], b = points[face.b], c = points[face.c];
        const Vector normal = cross(from_to(a, b), from_to(a, c));
        if (!(normal.length() > 0))
            throw BadUsage("triangle " + std::to_string(triangle) + " of scene '" + scene.name +
                           "' has no normal to be moved along");
        const double distance = diameters * box_diagonal(points, scene.faces) / normal.length();
        const Vector by = {distance * normal.x, distance * normal.y, distance * normal.z};
        points.insert(points.end(), {moved(a, by), moved(b, by), moved(c, by)});
    }
    scene.faces[place] = {first, first + 1, first + 2};
    scene.outlier = {scene.name, triangle, diameters};
    return scene;
}

}  // namespace bvhbench
