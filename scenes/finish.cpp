// SPDX-License-Identifier: MIT
#include "scenes/scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/error.h"
#include "geometry/hash.h"

namespace bvhbench {
namespace {

[[noreturn]] void refuse(const Scene& scene, const std::string& what)
{
    throw Unavailable("scene '" + scene.name + "' " + what);
}

void check_faces(const Scene& scene, std::size_t points)
{
    for (std::size_t k = 0; k < scene.faces.size(); ++k) {
        const Face& face = scene.faces[k];
        for (const uint corner : {face.a, face.b, face.c})
            if (corner >= points)
                refuse(scene, "has a triangle, " + std::to_string(k) + ", with vertex " +
                                  std::to_string(corner) + " of " + std::to_string(points));
    }
}

void canonicalise(Scene& scene, std::vector<Point>& points)
{
    for (std::size_t k = 0; k < points.size(); ++k) {
        Point& point = points[k];
        if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z))
            refuse(scene, "has a vertex, " + std::to_string(k) + ", that is not finite in float32");
        point = {point.x + 0.0f, point.y + 0.0f, point.z + 0.0f};  // -0 + 0 is +0
    }
}

/// Frames are made, and vertices joined and cut, in floats: the doubles of such a scene would be others.
void check_doubles(const Scene& scene)
{
    bool is_same = scene.wide.size() == scene.frames.size();
    for (std::size_t frame = 0; is_same && frame < scene.frames.size(); ++frame)
        is_same = std::ranges::equal(scene.wide[frame], scene.frames[frame],
                                     [](const WidePoint& kept, const Point& point) {
                                         return static_cast<float>(kept.x) == point.x &&
                                                static_cast<float>(kept.y) == point.y &&
                                                static_cast<float>(kept.z) == point.z;
                                     });
    if (!is_same)
        refuse(scene,
               "has doubles that cannot be kept, because its frames or vertices are changed in "
               "floats: --doubles recentred and as-is round them");
}

void check_objects(const Scene& scene)
{
    std::size_t covered = 0;
    for (const SceneObject& object : scene.objects) {
        if (object.first_face != covered || object.face_count == 0)
            refuse(scene,
                   "has an object, '" + object.name + "', that does not follow the one before");
        covered += object.face_count;
    }
    if (covered != scene.faces.size())
        refuse(scene, "has objects over " + std::to_string(covered) + " of its " +
                          std::to_string(scene.faces.size()) + " triangles");
}

std::uint64_t content_hash(const Scene& scene)
{
    Hash hash;
    hash.value(std::uint64_t{scene.faces.size()});
    hash.values(std::span(scene.faces));
    for (const SceneObject& object : scene.objects) {
        hash.value(object.first_face);
        hash.value(object.face_count);
    }
    for (const auto& points : scene.frames) {
        hash.value(std::uint64_t{points.size()});
        hash.values(std::span(points));
    }
    for (const auto& points : scene.wide)
        hash.values(std::span(points));
    for (const Scene& later : scene.later)
        hash.value(later.content_hash);
    return hash.get();
}

}  // namespace

void take_doubles(Scene& scene, std::vector<std::vector<WidePoint>> wide, Doubles how)
{
    scene.rounding = round_frames(wide, how, scene.frames);
    if (how != Doubles::kept)
        return;
    const WidePoint offset = scene.rounding.offset;
    for (std::vector<WidePoint>& points : wide)
        for (WidePoint& p : points)
            p = {p.x - offset.x + 0.0, p.y - offset.y + 0.0, p.z - offset.z + 0.0};  // no -0
    scene.wide = std::move(wide);
}

Scene finished(Scene scene)
{
    if (scene.faces.empty())
        refuse(scene, "has no triangles");
    if (scene.faces.size() > 0x80000000u)
        refuse(scene, "has " + std::to_string(scene.faces.size()) + " triangles, more than 2^31");
    if (scene.frames.empty())
        refuse(scene, "has no frames");
    for (auto& points : scene.frames) {
        if (points.size() != scene.frames.front().size())
            refuse(scene, "has frames of " + std::to_string(points.size()) + " and " +
                              std::to_string(scene.frames.front().size()) + " vertices");
        canonicalise(scene, points);
    }
    if (!scene.wide.empty())
        check_doubles(scene);
    if (!scene.frame_labels.empty() && scene.frame_labels.size() != scene.frame_count())
        refuse(scene, "has " + std::to_string(scene.frame_labels.size()) + " labels for " +
                          std::to_string(scene.frame_count()) + " frames");
    check_faces(scene, scene.frames.front().size());
    if (scene.objects.empty())
        scene.objects.push_back({"all", 0, static_cast<uint>(scene.faces.size())});
    check_objects(scene);
    for (Scene& later : scene.later) {
        later.name = scene.name;
        later.source = scene.source;
        later = finished(std::move(later));
    }
    scene.content_hash = content_hash(scene);
    return scene;
}

}  // namespace bvhbench
