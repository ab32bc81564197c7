// SPDX-License-Identifier: MIT
#include "scenes/face_order.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "geometry/error.h"
namespace bvhbench {
namespace {

template <class T>
std::vector<T> taken(const std::vector<T>& values, const std::vector<uint>& from)
{
    std::vector<T> result;
    result.reserve(from.size());
    for (const uint k : from)
        result.push_back(values[k]);
    return result;
}

/// Disjoint sets of vertices, each identified by its smallest vertex.
class Sets {
public:
    explicit Sets(std::size_t count) : parent_(count)
    {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }

    uint find(uint vertex)
    {
        while (parent_[vertex] != vertex)
            vertex = parent_[vertex] = parent_[parent_[vertex]];
        return vertex;
    }

    void join(uint a, uint b)
    {
        a = find(a);
        b = find(b);
        (a < b ? parent_[b] : parent_[a]) = a < b ? a : b;
    }

private:
    std::vector<uint> parent_;
};

constexpr std::pair<const char*, ObjectsBy> names[] = {
    {"auto", ObjectsBy::automatic},        {"one", ObjectsBy::one},       {"mesh", ObjectsBy::mesh},
    {"components", ObjectsBy::components}, {"groups", ObjectsBy::groups},
};

/// Makes the file's groups objects.
void group_by_file(Scene& scene)
{
    if (scene.groups.empty())
        throw BadUsage("scene '" + scene.name +
                       "' has no groups to take for objects: an OBJ file names them in lines that "
                       "begin with g");
    scene.objects.clear();
    scene.object_ids.clear();
    for (const std::string& group : scene.groups)
        scene.objects.push_back({group, 0, 0});
    scene.objects_are_parts = false;
    group_faces(scene, scene.file_faces.empty() ? scene.group_of_face
                                                : taken(scene.group_of_face, scene.file_faces));
}

}  // namespace

void group_faces(Scene& scene, std::span<const uint> object_of_face)
{
    for (SceneObject& object : scene.objects)
        object.face_count = 0;
    for (const uint object : object_of_face)
        ++scene.objects[object].face_count;
    std::vector<uint> next;  // for each object, the index of its next triangle
    uint first = 0;
    for (SceneObject& object : scene.objects) {
        object.first_face = first;
        next.push_back(first);
        first += object.face_count;
    }
    if (std::ranges::is_sorted(object_of_face))
        return;
    std::vector<uint> from(object_of_face.size());
    for (uint k = 0; k < from.size(); ++k)
        from[next[object_of_face[k]]++] = k;
    scene.faces = taken(scene.faces, from);
    scene.file_faces = scene.file_faces.empty() ? std::move(from) : taken(scene.file_faces, from);
}

void group_by_parts(Scene& scene)
{
    const std::size_t vertices = scene.frames.front().size();
    Sets sets(vertices);
    for (const Face& face : scene.faces) {
        sets.join(face.a, face.b);
        sets.join(face.a, face.c);
    }
    constexpr uint none = 0xffffffffu;
    std::vector<uint> number(vertices, none);  // of the component with this smallest vertex
    std::vector<uint> part_of_face;
    part_of_face.reserve(scene.faces.size());
    scene.objects.clear();
    scene.object_ids.clear();
    scene.objects_are_parts = true;
    for (const Face& face : scene.faces) {
        uint& part = number[sets.find(face.a)];
        if (part == none) {
            part = static_cast<uint>(scene.objects.size());
            scene.objects.push_back({"part " + std::to_string(part), 0, 0});
        }
        part_of_face.push_back(part);
    }
    group_faces(scene, part_of_face);
}

std::vector<Face> faces_in_file(const Scene& scene)
{
    std::vector<Face> faces = scene.faces;
    for (std::size_t k = 0; k < scene.file_faces.size(); ++k)
        faces[scene.file_faces[k]] = scene.faces[k];
    return faces;
}

std::vector<std::int64_t> objects_in_file(const Scene& scene)
{
    std::vector<std::int64_t> objects(scene.faces.size());
    for (std::size_t object = 0; object < scene.objects.size(); ++object) {
        const auto [name, first, count] = scene.objects[object];
        const std::int64_t id =
            scene.object_ids.empty() ? static_cast<std::int64_t>(object) : scene.object_ids[object];
        for (std::size_t k = first; k < std::size_t{first} + count; ++k)
            objects[scene.file_faces.empty() ? k : scene.file_faces[k]] = id;
    }
    return objects;
}

Scene in_file_order(Scene scene)
{
    if (scene.file_faces.empty())
        return scene;
    scene.faces = faces_in_file(scene);
    scene.file_faces.clear();
    scene.objects.clear();  // `finished` makes one object
    scene.object_ids.clear();
    scene.has_meshes = false;
    return finished(std::move(scene));
}

ObjectsBy objects_by_called(std::string_view name)
{
    for (const auto& [known, by] : names)
        if (name == known)
            return by;
    throw BadUsage("objects are chosen by auto, one, mesh, components or groups, not by '" +
                   std::string(name) + "'");
}

std::string_view objects_by_name(ObjectsBy by)
{
    for (const auto& [name, known] : names)
        if (by == known)
            return name;
    return "";
}

Scene with_objects(Scene scene, ObjectsBy by)
{
    for (Scene& later : scene.later)
        later = with_objects(std::move(later), by);
    switch (by) {
        case ObjectsBy::automatic:
            return scene;
        case ObjectsBy::mesh:
            if (!scene.has_meshes)
                throw BadUsage(
                    "scene '" + scene.name +
                    "' has no meshes to take for objects: what it was made from names none");
            return scene;
        case ObjectsBy::one:
            scene.objects.clear();  // `finished` makes one object
            scene.object_ids.clear();
            scene = in_file_order(std::move(scene));
            break;
        case ObjectsBy::components:
            group_by_parts(scene);
            break;
        case ObjectsBy::groups:
            group_by_file(scene);
            break;
    }
    scene.has_meshes = false;
    return finished(std::move(scene));
}

}  // namespace bvhbench
