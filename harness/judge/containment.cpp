// SPDX-License-Identifier: MIT
#include "harness/judge/containment.h"

#include <algorithm>
#include <set>

#include "geometry/orient.h"
#include "scenes/face_order.h"

namespace bvhbench {
namespace {

/// Returns on which side of the line from a to b, seen along z, a point lies that is moved from p by a little in x and by far less in
/// y, so that it is on no line; 0 only if a and b are one point there.
int side_of_moved(Point a, Point b, Point p)
{
    const int side = orient2d(a, b, p, 2);
    if (side != 0)
        return side;
    if (a.y != b.y)
        return a.y > b.y ? 1 : -1;
    return a.x == b.x ? 0 : a.x < b.x ? 1 : -1;
}

/// True if the ray from p along z, moved as above, meets a triangle.
bool ray_meets(Point p, Point a, Point b, Point c)
{
    const int side = side_of_moved(a, b, p);
    if (side == 0 || side_of_moved(b, c, p) != side || side_of_moved(c, a, p) != side)
        return false;
    return orient3d(a, b, c, p) == side;  // p is below it
}

class Frame {
public:
    Frame(const Scene& scene, const std::vector<Point>& points) : scene_(scene), points_(points) {}

    std::span<const Face> faces(std::size_t object) const
    {
        const SceneObject& at = scene_.objects[object];
        return std::span(scene_.faces).subspan(at.first_face, at.face_count);
    }

    bool is_closed(std::size_t object) const
    {
        std::vector<std::pair<uint, uint>> edges;
        for (const Face& face : faces(object))
            for (const auto& [u, v] :
                 {std::pair(face.a, face.b), std::pair(face.b, face.c), std::pair(face.c, face.a)})
                if (u != v)
                    edges.emplace_back(std::min(u, v), std::max(u, v));
        std::ranges::sort(edges);
        for (std::size_t k = 0, end = 0; k < edges.size(); k = end) {
            while (end < edges.size() && edges[end] == edges[k])
                ++end;
            if ((end - k) % 2 == 1)
                return false;
        }
        return true;
    }

    /// True if all of an object that does not touch the closed object `of` is inside of it: a corner of each connected part is.
    bool is_inside(std::size_t object, std::size_t of) const
    {
        return std::ranges::all_of(corners_of_parts(object), [&](uint corner) {
            bool inside = false;
            for (const Face& face : faces(of))
                inside ^=
                    ray_meets(points_[corner], points_[face.a], points_[face.b], points_[face.c]);
            return inside;
        });
    }

private:
    std::vector<uint> corners_of_parts(std::size_t object) const
    {
        Scene part;
        part.frames = {points_};
        part.faces.assign(faces(object).begin(), faces(object).end());
        group_by_parts(part);
        std::vector<uint> corners;
        for (const SceneObject& found : part.objects)
            corners.push_back(part.faces[found.first_face].a);
        return corners;
    }

    const Scene& scene_;
    const std::vector<Point>& points_;
};

/// Returns the pairs of objects that have a contact, or a vertex in common.
std::set<std::pair<std::size_t, std::size_t>> touching_objects(const Scene& scene,
                                                               std::span<const Pair> contacts)
{
    std::vector<std::size_t> object_of(scene.faces.size());
    std::vector<std::pair<uint, std::size_t>> users;  // vertices, with the objects that name them
    for (std::size_t object = 0; object < scene.objects.size(); ++object)
        for (uint k = 0; k < scene.objects[object].face_count; ++k) {
            const std::size_t at = scene.objects[object].first_face + k;
            object_of[scene.file_faces.empty() ? at : scene.file_faces[at]] = object;
            const Face& face = scene.faces[at];
            for (const uint corner : {face.a, face.b, face.c})
                users.emplace_back(corner, object);
        }
    std::ranges::sort(users);
    users.erase(std::unique(users.begin(), users.end()), users.end());
    std::set<std::pair<std::size_t, std::size_t>> touching;
    for (auto first = users.begin(); first != users.end(); ++first)
        for (auto other = first + 1; other != users.end() && other->first == first->first; ++other)
            touching.emplace(first->second, other->second);
    for (const Pair pair : contacts)
        touching.insert(std::minmax(object_of[pair.a], object_of[pair.b]));
    return touching;
}

}  // namespace

Containment containment(const Scene& scene, std::size_t frame, std::span<const Pair> contacts)
{
    const Frame now(scene, scene.frames[frame]);
    const auto touching = touching_objects(scene, contacts);
    std::vector<Aabb> boxes;
    for (std::size_t object = 0; object < scene.objects.size(); ++object)
        boxes.push_back(box_around(scene.frames[frame], now.faces(object)));
    Containment containment;
    for (std::size_t outer = 0; outer < boxes.size(); ++outer) {
        if (!now.is_closed(outer)) {
            ++containment.open_objects;
            continue;
        }
        for (std::size_t inner = 0; inner < boxes.size(); ++inner)
            if (inner != outer && contains(boxes[outer], boxes[inner]) &&
                !touching.contains(std::minmax(inner, outer)) && now.is_inside(inner, outer))
                containment.found.emplace_back(inner, outer);
    }
    return containment;
}

}  // namespace bvhbench
