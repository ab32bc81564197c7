// SPDX-License-Identifier: MIT
//
// Objects with some triangles near another object, and the near triangles by definition.
#pragma once

#include "collide/near.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {

inline Mesh sphere(std::size_t triangles)
{
    return scene_mesh("sphere:" + std::to_string(triangles));
}

inline float width(const Mesh& mesh)
{
    Aabb box = empty_box();
    for (const Face& face : mesh.faces)
        box = merged(box, face_box(mesh.points, face));
    return box.max_x - box.min_x;
}

/// Returns a row of squares, of two triangles each, from x = `first` on. Coordinates are small integers, so boxes touch exactly.
inline Mesh squares(uint first, uint count)
{
    Mesh mesh;
    for (uint k = 0; k < count; ++k) {
        const auto x = static_cast<float>(first + k);
        mesh.points.insert(mesh.points.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}});
        mesh.faces.push_back({4 * k, 4 * k + 1, 4 * k + 2});
        mesh.faces.push_back({4 * k, 4 * k + 2, 4 * k + 3});
    }
    return mesh;
}

/// Returns `count` spheres in a row, each `step` widths from the previous one.
inline ManyObjects row(uint count, float step, std::size_t triangles = 400)
{
    const Mesh part = sphere(triangles);
    ManyObjects many({});
    for (uint k = 0; k < count; ++k)
        many.add(part, static_cast<float>(k) * step * width(part));
    return many;
}

inline ManyObjects touching_squares()
{
    ManyObjects many({});
    many.add(squares(0, 6), 0);
    many.add(squares(6, 5), 0);
    many.add(squares(12, 4), 0);  // one square further away
    return many;
}

/// Returns two spheres that meet, and two far ones: one between them and one after them in the order of triangles.
inline ManyObjects some_far()
{
    ManyObjects many = row(1, 0);
    const Mesh part = sphere(100);
    many.add(part, 1000);
    many.add(sphere(500), 0.8f * width(sphere(400)));
    many.add(part, -1000);
    return many;
}

/// Returns a triangle inside a sphere: near the sphere's box, but near no triangle of it.
inline ManyObjects one_inside()
{
    ManyObjects many = row(1, 0);
    many.add({{{0, 0, 0}, {0.01f, 0, 0}, {0, 0.01f, 0}}, {{0, 1, 2}}}, 0);
    return many;
}

inline ManyObjects bodies()
{
    const Scene scene = load_scene("n-body:6100:3", {});
    ManyObjects many({});
    many.mesh = {scene.frames.front(), scene.faces};
    for (const SceneObject& object : scene.objects) {
        many.owners.resize(object.first_face + object.face_count,
                           static_cast<uint>(many.objects.size()));
        many.objects.push_back({object.first_face, object.face_count});
    }
    return many;
}

struct NamedObjects {
    std::string name;
    ManyObjects many;
};

inline std::vector<NamedObjects> all_objects()
{
    return {{"overlapping", row(2, 0.9f)}, {"apart", row(3, 1.5f)},
            {"some far", some_far()},      {"touching", touching_squares()},
            {"one inside", one_inside()},  {"bodies", bodies()}};
}

/// Returns, per object, the triangles whose box overlaps another object's box, by the definition.
inline std::vector<std::vector<uint>> near_by_definition(const ManyObjects& many)
{
    const std::vector<Aabb> triangles = face_boxes(many.mesh.points, many.mesh.faces);
    std::vector<Aabb> boxes(many.objects.size(), empty_box());
    for (std::size_t k = 0; k < triangles.size(); ++k)
        boxes[many.owners[k]] = merged(boxes[many.owners[k]], triangles[k]);
    std::vector<std::vector<uint>> near(many.objects.size());
    for (uint k = 0; k < triangles.size(); ++k) {
        const Aabb box = triangles[k];
        for (uint other = 0; other < boxes.size(); ++other)
            if (other != many.owners[k] && overlap(box, boxes[other])) {
                near[many.owners[k]].push_back(k);
                break;
            }
    }
    return near;
}

inline Input uploaded(const ManyObjects& many)
{
    return uploaded(many.mesh.points, many.mesh.faces, many.objects);
}

inline std::size_t entering(const ManyObjects& many)
{
    std::size_t total = 0;
    for (const std::vector<uint>& near : near_by_definition(many))
        total += near.size();
    return total;
}

}  // namespace bvhbench
