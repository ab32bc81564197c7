// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "builders/device_tree.h"
#include "collide/relation.h"
#include "tests/collide/collider_testing.h"

namespace bvhbench {

/// Objects that lie across each other, one of them a single triangle, and one far from all others.
struct ManyObjects {
    Mesh mesh;
    std::vector<FaceRange> objects;
    std::vector<uint> owners;

    explicit ManyObjects(const std::vector<std::size_t>& sizes)
    {
        for (std::size_t k = 0; k < sizes.size(); ++k) {
            const std::vector<NamedMesh> meshes = hard_meshes(sizes[k]);
            const bool is_far = k == 2;
            add(meshes[k % meshes.size()].mesh, is_far ? 1000.0f : 0.3f * static_cast<float>(k));
        }
    }

    void add(const Mesh& part, float along)
    {
        const auto base = static_cast<uint>(mesh.points.size());
        objects.push_back(
            {static_cast<uint>(mesh.faces.size()), static_cast<uint>(part.faces.size())});
        for (const Point& point : part.points)
            mesh.points.push_back({point.x + along, point.y, point.z});
        for (const Face& face : part.faces)
            mesh.faces.push_back({face.a + base, face.b + base, face.c + base});
        owners.resize(mesh.faces.size(), static_cast<uint>(objects.size() - 1));
    }
};

/// Trees of many objects on the device.
struct StandingForest {
    Input input;
    std::unique_ptr<Builder> builder;
    const Tree* tree = nullptr;

    StandingForest(const ManyObjects& many, MakeBuilder make, const BuildOptions& options = {})
        : input(upload(session().device(), session().queue(), many.mesh.points, many.mesh.faces,
                       many.objects))
        , builder(make(session().programs(), options))
    {
        builder->reserve_objects(object_sizes(input));
        session().build_once(*builder, input, Start::from_triangles, &tree);
    }
    const DeviceTree& device_tree() const { return dynamic_cast<const DeviceTree&>(*tree); }
};

inline PairList expected_pairs(const ManyObjects& many, Among among, bool keep_adjacent)
{
    const PairList all = touching_pairs(many.mesh.points, many.mesh.faces, keep_adjacent);
    std::vector<Pair> chosen;
    for (const Pair pair : all.pairs()) {
        const bool is_between = many.owners[pair.a] != many.owners[pair.b];
        if (among == Among::all || is_between == (among == Among::between_objects))
            chosen.push_back(pair);
    }
    return PairList(std::move(chosen));
}

}  // namespace bvhbench
