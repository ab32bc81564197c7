// SPDX-License-Identifier: MIT
//
// Queries over trees with rounded boxes find exactly the pairs whose stored boxes overlap: no pair of exact boxes is missed, and
// the number of false pairs is known beforehand.

#include "scenes/generate/generators.h"
#include "tests/brute_pairs.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

Aabb scene_of(std::span<const Aabb> boxes)
{
    return std::accumulate(boxes.begin(), boxes.end(), empty_box(), merged);
}

/// Returns each box with the sides that kernels store and compare. In formats with cells these are whole numbers of at most 16
/// bits, which floats hold exactly.
std::vector<Aabb> stored_sides(std::vector<Aabb> boxes, const BoxFormat& format)
{
    if (!format.has_cells())
        return boxes;
    const auto [x, y, z] = BoxRounding::of_scene(format, scene_of(boxes)).cells;
    const auto side = [&](const AxisCells& axis, float at, bool is_upper) {
        return static_cast<float>(side_in(format.number, axis, at, is_upper));
    };
    for (Aabb& box : boxes)
        box = {side(x, box.min_x, false), side(y, box.min_y, false), side(z, box.min_z, false),
               side(x, box.max_x, true),  side(y, box.max_y, true),  side(z, box.max_z, true)};
    return boxes;
}

/// Returns the pairs of faces without a common corner whose boxes overlap, by testing all pairs.
PairList overlapping(std::span<const Aabb> boxes, std::span<const Face> faces)
{
    return chosen(PairList(brute_pairs(boxes)),
                  [&](Pair pair) { return !share_a_vertex(faces[pair.a], faces[pair.b]); });
}

/// Returns the pairs that a query over boxes of a format finds.
PairList rounded_pairs(const Mesh& mesh, const BoxFormat& format)
{
    return overlapping(stored_sides(face_boxes(mesh.points, mesh.faces), format), mesh.faces);
}

bool contains(const PairList& all, const PairList& some)
{
    return std::ranges::includes(all.pairs(), some.pairs());
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

/// All colliders over u16, at night in both kernel forms. Other formats differ from u16 in types only, so they run those colliders
/// that do more with boxes than compare them: lanes and areas.
std::vector<Case> cases_of(const BoxFormat& format)
{
    std::vector<Case> all;
    for (int turn = 0; const ColliderEntry& collider : box_colliders(true)) {
        ++turn;
        for (const KernelForm form : {KernelForm::groups, KernelForm::chunks}) {
            const bool in_groups = form == KernelForm::groups;
            const bool does_more =
                collider.name == "group" || (collider.name == "block" && in_groups);
            if (does_more || (format.number == BOX_U16 && takes_combination({turn, in_groups})))
                all.emplace_back(format, collider, form);
        }
    }
    return all;
}

std::vector<Case> cases()
{
    std::vector<Case> all;
    for (const BoxFormat& format : box_formats().subspan(1))
        std::ranges::copy(cases_of(format), std::back_inserter(all));
    return all;
}

BuildOptions tree_of(const BoxFormat& format)
{
    return {.sorted_leaves = true, .boxes = std::string(format.name)};
}

/// Compares the pairs that a collider finds with those expected.
void expect_found(const PairList& expected, const Standing& standing, const ColliderEntry& entry,
                  KernelForm form)
{
    const auto collider = made(entry.name, {.keep_adjacent = false, .form = form});
    collider->reserve(standing.tree, standing.input);
    expect_pairs(*collider, standing, expected);
}

class BoxFormats : public testing::TestWithParam<Case> {
protected:
    const BoxFormat& format() const { return std::get<0>(GetParam()); }

    PairList expect_rounded_pairs(const Standing& standing) const
    {
        PairList rounded = rounded_pairs(standing.mesh, format());
        expect_found(rounded, standing, std::get<1>(GetParam()), std::get<2>(GetParam()));
        return rounded;
    }
};

TEST_P(BoxFormats, FindThePairsOfRoundedBoxesAndMissNone)
{
    for (const auto& [name, mesh] : telling_meshes()) {
        SCOPED_TRACE(name + ", " + std::to_string(mesh.faces.size()) + " triangles");
        const Standing standing(mesh, "oibvh-multi", tree_of(format()));
        const PairList pairs = expect_rounded_pairs(standing), exact = standing.expected(false);
        EXPECT_TRUE(contains(pairs, exact));
    }
}

/// Small enough for a simulated device that checks every memory access.
TEST_P(BoxFormats, FindThePairsOfFew)
{
    expect_rounded_pairs(Standing(crowded_mesh(21), "oibvh-single", tree_of(format())));
}

/// Boxes of different trees are compared, so all objects must be rounded to the same cells.
TEST_P(BoxFormats, FindThePairsOfSeveralObjectsToo)
{
    expect_rounded_pairs(ManyObjects({1, 70, 3, 2, 129, 200, 1})
                             .standing(find_builder("oibvh-single").make, tree_of(format())));
}

/// Soups where neighbouring floats are about as far apart as cells, or further.
std::vector<NamedMesh> far_soups()
{
    std::vector<NamedMesh> meshes;
    for (const float shift : {1e5f, 1e6f})
        for (uint triangles = 2; triangles <= 70; triangles += takes_all_cases() ? 1 : 17) {
            Mesh mesh = make_soup(triangles);
            for (Point& p : mesh.points)
                p = {shift + 8 * p.x, shift + 8 * p.y, shift + 8 * p.z};
            meshes.push_back({"soup near " + std::to_string(shift), mesh});
        }
    return meshes;
}

class FarBoxes : public testing::TestWithParam<BoxFormat> {};

/// Stored boxes lie between the exact ones and those that BoxRounding reads, which are rounded a second time.
TEST_P(FarBoxes, OverlapIfExactOnesDoAndOnlyIfThoseReadDo)
{
    std::size_t apart_as_stored = 0;
    for (const auto& [name, mesh] : far_soups()) {
        const std::vector<Aabb> boxes = face_boxes(mesh.points, mesh.faces);
        const auto rounding = BoxRounding::of_scene(GetParam(), scene_of(boxes));
        std::vector<Aabb> read;
        std::transform(boxes.begin(), boxes.end(), std::back_inserter(read), rounding);
        const PairList stored = rounded_pairs(mesh, GetParam());
        const PairList loosest = overlapping(read, mesh.faces);
        ASSERT_TRUE(contains(stored, overlapping(boxes, mesh.faces)));
        ASSERT_TRUE(contains(loosest, stored));
        apart_as_stored += loosest.size() - stored.size();
    }
    EXPECT_EQ(apart_as_stored > 0, GetParam().has_cells()) << "these soups show no difference";
}

TEST_P(FarBoxes, AreComparedAsStored)
{
    for (const auto& [name, mesh] : far_soups()) {
        const Standing standing(mesh, "oibvh-single", tree_of(GetParam()));
        const PairList rounded = rounded_pairs(mesh, GetParam());
        for (const auto& [format, collider, form] : cases_of(GetParam())) {
            SCOPED_TRACE(name + ", " + std::to_string(mesh.faces.size()) + " triangles, " +
                         std::string(collider.name) + ", " + name_of(form));
            expect_found(rounded, standing, collider, form);
        }
    }
}

/// Their nodes are packed otherwise.
TEST_P(FarBoxes, AreReadFromRadixTreesToo)
{
    const Mesh mesh = far_soups().back().mesh;
    expect_found(rounded_pairs(mesh, GetParam()), Standing(mesh, "karras", tree_of(GetParam())),
                 find_collider("leaf"), KernelForm::groups);
}

INSTANTIATE_TEST_SUITE_P(Catalog, FarBoxes, testing::ValuesIn(box_formats().subspan(1)),
                         CaseName());
INSTANTIATE_TEST_SUITE_P(Catalog, BoxFormats, testing::ValuesIn(cases()), CaseName());

}  // namespace
}  // namespace bvhbench
