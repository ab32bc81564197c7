// SPDX-License-Identifier: MIT
#include "scenes/generate/derived.h"

#include <algorithm>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "scenes/formats/text.h"
#include "scenes/generate/vector.h"

namespace bvhbench {
namespace {

double box_diagonal(const std::vector<Point>& points, const std::vector<Face>& faces)
{
    const Aabb box = box_around(points, faces);
    return length(difference({box.max_x, box.max_y, box.max_z}, {box.min_x, box.min_y, box.min_z}));
}

/// Returns b of the position of `x` between `low` and `high`; 0 if the two are equal.
double bump(double x, double low, double high)
{
    if (!(high > low))
        return 0;
    const double t = (x - low) / (high - low);
    return 4 * t * (1 - t);
}

std::vector<Point> blend(const std::vector<Point>& from, const std::vector<Point>& to, double t)
{
    std::vector<Point> points;
    points.reserve(from.size());
    for (std::size_t k = 0; k < from.size(); ++k)
        points.push_back(rounded((1 - t) * vector_of(from[k]) + t * vector_of(to[k])));
    return points;
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
        const Point corners[] = {points[face.a], points[face.b], points[face.c]};
        const Vector normal =
            cross(difference(corners[1], corners[0]), difference(corners[2], corners[0]));
        if (!(length(normal) > 0))
            throw BadUsage("triangle " + std::to_string(triangle) + " of scene '" + scene.name +
                           "' has no normal to be moved along");
        const double distance = diameters * box_diagonal(points, scene.faces) / length(normal);
        for (const Point& corner : corners)
            points.push_back(rounded(vector_of(corner) + distance * normal));
    }
    scene.faces[place] = {first, first + 1, first + 2};
    scene.outlier = {scene.name, triangle, diameters};
    return scene;
}

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
        const Vector by = {bump(point.y, box.min_y, box.max_y), bump(point.z, box.min_z, box.max_z),
                           bump(point.x, box.min_x, box.max_x)};
        bent.push_back(rounded(vector_of(point) + (1.0 / 32 * side) * by));
    }
    scene.frames.push_back(std::move(bent));
    scene.frame_labels.clear();
    scene.bend_of = scene.name;
    return scene;
}

Scene with_frames_between(Scene scene, uint between)
{
    if (between == 0)
        return scene;
    if (scene.frames.size() < 2)
        throw BadUsage("scene '" + scene.name + "' has one frame, and none lies between");
    const std::uint64_t parts = std::uint64_t{between} + 1;
    const std::uint64_t frames = (scene.frames.size() - 1) * parts + 1;
    require_host_memory("scene " + in_quotes(scene.name) + " with the frames between",
                        frames * scene.frames.front().size() * sizeof(Point));

    std::vector<std::vector<Point>> all;
    std::vector<std::string> labels;
    for (std::uint64_t k = 0; k < frames; ++k) {
        const std::size_t before = k / parts;
        const std::uint64_t part = k % parts;
        if (!scene.frame_labels.empty())
            labels.push_back(
                scene.frame_labels[before] +
                (part == 0 ? "" : "+" + std::to_string(part) + "/" + std::to_string(parts)));
        if (part != 0)
            all.push_back(blend(scene.frames[before], scene.frames[before + 1],
                                static_cast<double>(part) / static_cast<double>(parts)));
        else
            all.push_back(scene.frames[before]);
    }
    scene.frames = std::move(all);
    scene.frame_labels = std::move(labels);
    scene.folder.clear();  // the folder's frames are further apart
    return finished(std::move(scene));
}

}  // namespace bvhbench
