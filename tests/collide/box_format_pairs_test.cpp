// SPDX-License-Identifier: MIT
//
// Queries over trees with rounded boxes find exactly the pairs whose rounded boxes overlap: no pair of exact boxes is missed, and
// the number of false pairs is known beforehand.
#include "builders/device_tree.h"
#include "tests/collide/collider_testing.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

/// Returns the pairs of faces without a common corner whose rounded boxes overlap, by testing all pairs.
PairList rounded_pairs(const Mesh& mesh, const BoxFormat& format)
{
    Aabb scene = empty_box();
    for (const Face& face : mesh.faces)
        scene = merged(scene, face_box(mesh.points, face));
    const auto rounding = BoxRounding::of_scene(format, scene);
    std::vector<Aabb> boxes;
    for (const Face& face : mesh.faces)
        boxes.push_back(rounding(face_box(mesh.points, face)));
    std::vector<Pair> pairs;
    for (uint a = 0; a < boxes.size(); ++a)
        for (uint b = a + 1; b < boxes.size(); ++b)
            if (overlap(boxes[a], boxes[b]) && !share_a_vertex(mesh.faces[a], mesh.faces[b]))
                pairs.push_back({a, b});
    return PairList(std::move(pairs));
}

/// Returns meshes of few triangles, and of as many as blocks and work-groups need.
std::vector<NamedMesh> telling_meshes()
{
    std::vector<NamedMesh> meshes = hard_meshes(9);
    meshes.push_back({"one", crowded_mesh(1)});
    meshes.push_back({"two", crowded_mesh(2)});
    meshes.push_back({"crowded", crowded_mesh(130)});
    meshes.push_back({"collinear", collinear_mesh(200)});
    meshes.push_back(hard_meshes(400).back());
    meshes.push_back({"scattered", hard_inputs().front().make(1500)});
    return meshes;
}

/// A box format, a collider over trees of that format, and a kernel form.
using Case = std::tuple<BoxFormat, ColliderEntry, KernelForm>;

/// All colliders in both kernel forms over u16. Other formats differ from u16 in types only, so they run those colliders that do
/// more with boxes than compare them: lanes and areas.
std::vector<Case> cases()
{
    std::vector<Case> all;
    for (const BoxFormat& format : box_formats().subspan(1))
        for (const ColliderEntry& collider : box_colliders(true))
            for (const KernelForm form : {KernelForm::groups, KernelForm::chunks})
                if (format.number == BOX_U16 || collider.name == "group" ||
                    (collider.name == "block" && form == KernelForm::groups))
                    all.emplace_back(format, collider, form);
    return all;
}

class BoxFormats : public testing::TestWithParam<Case> {
protected:
    const BoxFormat& format() const { return std::get<0>(GetParam()); }

    BuildOptions options() const { return {.sorted_leaves = true, .boxes = format().name}; }

    /// Compares the pairs found with the pairs of rounded boxes.
    PairList expect_rounded_pairs(const Standing& standing) const
    {
        const auto collider = made(std::get<1>(GetParam()).name,
                                   {.keep_adjacent = false, .form = std::get<2>(GetParam())});
        collider->reserve(standing.tree, standing.input);
        PairList rounded = rounded_pairs(standing.mesh, format());
        expect_pairs(*collider, standing, rounded);
        return rounded;
    }
};

TEST_P(BoxFormats, FindThePairsOfRoundedBoxesAndMissNone)
{
    for (const auto& [name, mesh] : telling_meshes()) {
        SCOPED_TRACE(name + ", " + std::to_string(mesh.faces.size()) + " triangles");
        const Standing standing(mesh, "oibvh-multi", options());
        const PairList pairs = expect_rounded_pairs(standing), exact = standing.expected(false);
        EXPECT_TRUE(std::includes(pairs.pairs().begin(), pairs.pairs().end(), exact.pairs().begin(),
                                  exact.pairs().end()));
    }
}

/// Small enough for a simulated device that checks every memory access.
TEST_P(BoxFormats, FindThePairsOfFew)
{
    expect_rounded_pairs(Standing(crowded_mesh(21), "oibvh-single", options()));
}

/// Boxes of different trees are compared, so all objects must be rounded to the same cells.
TEST_P(BoxFormats, FindThePairsOfSeveralObjectsToo)
{
    expect_rounded_pairs(ManyObjects({1, 70, 3, 2, 129, 200, 1})
                             .standing(find_builder("oibvh-single").make, options()));
}

INSTANTIATE_TEST_SUITE_P(Catalog, BoxFormats, testing::ValuesIn(cases()), CaseName());

}  // namespace
}  // namespace bvhbench
