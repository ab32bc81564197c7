// SPDX-License-Identifier: MIT
#pragma once

#include "collide/pairs.h"
#include "tests/collide/collider_testing.h"

namespace bvhbench {

/// A mesh of several objects.
struct ManyObjects {
    Mesh mesh;
    std::vector<FaceRange> objects;
    std::vector<uint> owners;        ///< object of each face
    std::vector<uint> point_owners;  ///< object of each vertex

    /// Makes objects that overlap each other, one of them a single triangle, and one that is far from all others.
    explicit ManyObjects(const std::vector<std::size_t>& sizes)
    {
        for (std::size_t k = 0; k < sizes.size(); ++k) {
            const std::vector<NamedMesh> meshes = hard_meshes(sizes[k]);
            const bool is_far = k == 2;
            add(meshes[k % meshes.size()].mesh, is_far ? 1000.0f : 0.3f * static_cast<float>(k));
        }
    }

    void add(const Mesh& part, float along = 0)
    {
        const auto base = static_cast<uint>(mesh.points.size());
        objects.push_back(
            {static_cast<uint>(mesh.faces.size()), static_cast<uint>(part.faces.size())});
        for (const Point& point : part.points)
            mesh.points.push_back({point.x + along, point.y, point.z});
        for (const Face& face : part.faces)
            mesh.faces.push_back({face.a + base, face.b + base, face.c + base});
        owners.resize(mesh.faces.size(), static_cast<uint>(objects.size() - 1));
        point_owners.resize(mesh.points.size(), static_cast<uint>(objects.size() - 1));
    }

    Standing standing(MakeBuilder make, const BuildOptions& options = {}) const
    {
        return {mesh, make, options, objects};
    }
};

/// A collider, a builder for it and how its kernels run.
using ObjectsCase = std::tuple<Named, Named, KernelForm>;

/// Returns a case of each kind of tree and of walk that tests objects first.
inline std::vector<ObjectsCase> cases_of_objects()
{
    return first_by_day<ObjectsCase>(4, {{{"leaf"}, {"oibvh-multi"}, KernelForm::groups},
                                         {{"group"}, {"oibvh-multi"}, KernelForm::chunks},
                                         {{"block"}, {"hploc"}, KernelForm::groups},
                                         {{"bvtt"}, {"apetrei-fused"}, KernelForm::chunks},
                                         {{"leaf"}, {"karras"}, KernelForm::chunks},
                                         {{"group"}, {"oibvh-wide8"}, KernelForm::groups},
                                         {{"bvtt"}, {"oibvh-multi"}, KernelForm::groups}});
}

inline PairList expected_pairs(const ManyObjects& many, Among among, bool keep_adjacent)
{
    return touching_pairs(many.mesh.points, many.mesh.faces, keep_adjacent, many.objects, among);
}

/// Expects the oracle's pairs of a collider without a tree, with the mesh as these objects and as one, whatever is asked for, also where
/// its first list is too short. `made` makes the collider for options.
template <class Made>
void expect_pairs_of_objects(const ManyObjects& many, const Made& made)
{
    const std::vector<FaceRange> one = {{0, static_cast<uint>(many.mesh.faces.size())}};
    for (const std::vector<FaceRange>& ranges : {many.objects, one})
        for (const Among among : {Among::all, Among::between_objects, Among::within_objects})
            for (const std::size_t capacity : {0u, 1u}) {
                SCOPED_TRACE(std::to_string(ranges.size()) + " objects, among " +
                             std::to_string(static_cast<int>(among)));
                expect_oracles_pairs(*made({.among = among, .capacity = capacity}),
                                     Standing(many.mesh, nullptr, {}, ranges), true, among);
            }
}

}  // namespace bvhbench
