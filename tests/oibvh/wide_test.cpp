// SPDX-License-Identifier: MIT
//
// Wide trees: the arithmetic is Appendix C's, stored boxes contain what they are made of whatever the numbers, and what
// the kernels leave is what a literal construction leaves, bit for bit.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "builders/spell_out.h"
#include "geometry/error.h"
#include "oibvh/kary_layout.h"
#include "oibvh/oibvh.h"
#include "oibvh/wide/grid_box.h"
#include "oibvh/wide/layout.h"
#include "oibvh/wide/tree.h"
#include "tests/builders/stage_testing.h"

namespace bvhbench {
namespace {

TEST(WideLayout, IsAppendixCsOfInnerNodes)
{
    // One above a power: every digit of the virtual leaves is as large as can be.
    std::vector<uint> sizes = {144046,         1087474,        2880000,        4194304,
                               (1u << 24) + 1, (1u << 27) + 1, (1u << 30) - 1, 1u << 30};
    for (uint leaves = 2; leaves < 5000; ++leaves)
        sizes.push_back(leaves);
    for (const uint bits : {2u, 3u})
        for (const uint leaves : sizes) {
            const KaryShape shape = kary_shape(leaves, 1u << bits);
            ASSERT_EQ(wide_leaf_level(leaves, bits), shape.leaf_level) << leaves;
            for (uint level = 0; level <= shape.leaf_level; ++level) {
                ASSERT_EQ(wide_real_on(leaves, bits, level), kary_real_on(shape, level)) << leaves;
                ASSERT_EQ(wide_first_slot(leaves, bits, level), kary_first_slot(shape, level))
                    << leaves << ", level " << level;
            }
            ASSERT_EQ(wide_inner_count(leaves, bits), kary_node_count(shape) - leaves);
        }
}

TEST(WideLayout, PutsANodeAboveASingleLeaf)
{
    for (const uint bits : {2u, 3u}) {
        EXPECT_EQ(wide_leaf_level(1, bits), 1u);
        EXPECT_EQ(wide_real_on(1, bits, 0), 1u);
        EXPECT_EQ(wide_real_on(1, bits, 1), 1u);
        EXPECT_EQ(wide_inner_count(1, bits), 1u);
    }
}

bool contains(const Aabb& outer, const Aabb& inner)
{
    return outer.min_x <= inner.min_x && outer.min_y <= inner.min_y && outer.min_z <= inner.min_z &&
           outer.max_x >= inner.max_x && outer.max_y >= inner.max_y && outer.max_z >= inner.max_z;
}

/// Finite floats of every size, denormals as well; -0 is no coordinate of a box.
class AnyFloats {
public:
    float next()
    {
        float value = 0;
        do {
            const auto bits = static_cast<std::uint32_t>(random_());
            std::memcpy(&value, &bits, sizeof value);
        } while (!(std::abs(value) <= std::numeric_limits<float>::max()));
        return value == 0 ? 0.0f : value;
    }
    /// One of `near`, or a few floats beside it.
    float beside(float near)
    {
        for (int step = static_cast<int>(random_() % 8); step > 0; --step)
            near = std::nextafter(near, random_() % 2 == 0 ? -1e38f : 1e38f);
        return near == 0 ? 0.0f : near;
    }
    std::uint32_t any() { return static_cast<std::uint32_t>(random_()); }

private:
    std::mt19937 random_{20200511};
};

Aabb box_of_sides(float ax, float bx, float ay, float by, float az, float bz)
{
    return {std::min(ax, bx), std::min(ay, by), std::min(az, bz),
            std::max(ax, bx), std::max(ay, by), std::max(az, bz)};
}

/// The boxes of a node's children, of one of several kinds.
std::vector<Aabb> some_boxes(AnyFloats& floats, int kind)
{
    const float at = floats.next(), scale = 1e-3f * at;
    const auto number = [&]() -> float {
        const float unit = static_cast<float>(floats.any() >> 8) * 0x1p-24f;
        switch (kind) {
            case 0:
                return floats.next();  // from one end of the floats to the other
            case 1:
                return floats.beside(at);  // a few bits apart
            case 2:
                return at + scale * unit;
            case 3:
                return unit * std::numeric_limits<float>::denorm_min() * 1000;
            case 4:
                return (unit - 0.5f) * 2 * 3.4e38f;
            case 5:
                return at;  // flat
            default:
                return unit;
        }
    };
    std::vector<Aabb> boxes;
    for (int k = 0; k < 8; ++k)
        boxes.push_back(box_of_sides(number(), number(), number(), number(),
                                     kind == 6 ? 0.25f : number(), kind == 6 ? 0.25f : number()));
    return boxes;
}

TEST(GridBox, ContainsTheBoxItIsMadeOfWhateverTheNumbers)
{
    AnyFloats floats;
    for (int round = 0; round < 300000; ++round) {
        const std::vector<Aabb> boxes = some_boxes(floats, round % 8);
        Aabb whole = empty_box();
        for (const Aabb& box : boxes)
            whole = merged(whole, box);
        const BoxGrid grid = grid_of(whole);
        Aabb stored_whole = empty_box();
        for (const Aabb& box : boxes) {
            const GridBox points = points_around(grid, box);
            for (const uint point : {points.min_x, points.min_y, points.min_z, points.max_x,
                                     points.max_y, points.max_z})
                ASSERT_LE(point, 255u);
            const Aabb stored = box_between(grid, points);
            ASSERT_TRUE(contains(stored, box)) << "round " << round;
            stored_whole = merged(stored_whole, stored);
        }
        const Aabb on_grid = box_between(grid, points_around(grid, whole));
        ASSERT_EQ(std::memcmp(&on_grid, &stored_whole, sizeof on_grid), 0) << "round " << round;
    }
}

TEST(GridBox, IsAStepTooLargeAtMostWhereNothingOverflows)
{
    AnyFloats floats;
    for (int round = 0; round < 100000; ++round) {
        const std::vector<Aabb> boxes = some_boxes(floats, 7);
        const Aabb whole = merged(boxes[0], boxes[1]);
        const BoxGrid grid = grid_of(whole);
        const float step = as_float(grid_step_x(grid) << 23u);
        EXPECT_LE(step, (whole.max_x - whole.min_x) / 127);
        const Aabb stored = box_between(grid, points_around(grid, boxes[0]));
        EXPECT_LE(boxes[0].min_x - stored.min_x, step);
        EXPECT_LE(stored.max_x - boxes[0].max_x, step);
    }
}

struct Way {
    const char* name;
    MakeBuilder make;
    uint bits;
    bool on_grid;
};

constexpr Way ways[] = {{"wide4", make_oibvh_wide4, 2, false},
                        {"wide8", make_oibvh_wide8, 3, false},
                        {"wide8_q8", make_oibvh_wide8_q8, 3, true}};

/// By definition: rows of nodes from the leaves up, each over the next so many of the row below; the topmost row's
/// boxes of one node. What a box is stored as depends on its parent, so rows keep exact ones first.
struct LiteralWide {
    std::vector<std::vector<Aabb>> exact, stored;  ///< by level, the root's first

    LiteralWide(std::vector<Aabb> leaves, uint children, bool on_grid)
    {
        exact = {std::move(leaves)};
        do {
            const std::vector<Aabb> below = exact.front();
            std::vector<Aabb> row, row_stored(below.size());
            for (std::size_t first = 0; first < below.size(); first += children) {
                const std::size_t end = std::min(below.size(), first + children);
                Aabb whole = empty_box(), seen = empty_box();
                for (std::size_t k = first; k < end; ++k)
                    whole = merged(whole, below[k]);
                for (std::size_t k = first; k < end; ++k) {
                    row_stored[k] = on_grid ? box_between(grid_of(whole),
                                                          points_around(grid_of(whole), below[k]))
                                            : below[k];
                    seen = merged(seen, row_stored[k]);
                }
                row.push_back(seen);
            }
            exact.insert(exact.begin(), row);
            stored.insert(stored.begin(), row_stored);
        } while (exact.front().size() > 1);
        stored.insert(stored.begin(), exact.front());
    }
};

Mesh soup(uint triangles, float size)
{
    std::mt19937 random(triangles);
    const auto next = [&] { return size * (static_cast<float>(random() >> 8) * 0x1p-24f - 0.5f); };
    Mesh mesh;
    for (uint k = 0; k < triangles; ++k) {
        const Point at = {next(), next(), next()};
        for (int corner = 0; corner < 3; ++corner)
            mesh.points.push_back({at.x + next() / 16, at.y + next() / 16, at.z + next() / 16});
        mesh.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    return mesh;
}

/// Hold a tree, and every box as it is stored, to the literal one over the reference's leaves.
void expect_literal(const WideTree& tree, const HostTree& reference, const Way& way)
{
    const HostTree found = tree.spelled_out();
    std::vector<Aabb> leaves;
    std::vector<int> primitives;
    for (const HostTree::Node& node : reference.nodes)  // the last level, from the left
        if (node.primitive != HostTree::none) {
            leaves.push_back(node.box);
            primitives.push_back(node.primitive);
        }
    const LiteralWide literal(leaves, 1u << way.bits, way.on_grid);
    const std::vector<Aabb> stored = tree.stored_boxes(0);
    std::size_t slot = 0;
    for (std::size_t level = 0; level < literal.stored.size(); ++level)
        for (std::size_t k = 0; k < literal.stored[level].size(); ++k, ++slot) {
            const bool is_leaf = level + 1 == literal.stored.size();
            const Aabb& box = is_leaf ? leaves[k] : literal.stored[level][k];
            ASSERT_LT(slot, found.nodes.size());
            ASSERT_EQ(std::memcmp(&found.nodes[slot].box, &box, sizeof box), 0) << "slot " << slot;
            ASSERT_EQ(found.nodes[slot].primitive, is_leaf ? primitives[k] : HostTree::none);
            if (level == 0)
                continue;
            const std::size_t parent =
                slot - k - literal.stored[level - 1].size() + (k >> way.bits);
            const Aabb& kept = stored[(parent << way.bits) + k % (1u << way.bits)];
            ASSERT_EQ(std::memcmp(&kept, &literal.stored[level][k], sizeof kept), 0) << slot;
            ASSERT_TRUE(contains(kept, box));
        }
    ASSERT_EQ(slot, found.nodes.size());
    EXPECT_EQ(found.is_tight, !way.on_grid);
}

class Wide : public testing::TestWithParam<Way> {
protected:
    void expect_at(uint triangles, float size, const BuildOptions& options)
    {
        SCOPED_TRACE(std::to_string(triangles) + " triangles, groups of " +
                     std::to_string(options.group_size) +
                     (options.sorted_leaves ? ", sorted" : ""));
        const Mesh mesh = soup(triangles, size);
        const Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces);
        const auto reference = make_oibvh_reference(bench().programs, {});
        reference->reserve(triangles);
        const HostTree expected = reference->build(input, bench().queue).spelled_out();
        const auto builder = GetParam().make(bench().programs, options);
        builder->reserve(triangles);
        ASSERT_EQ(builder->footprint(triangles), builder->reserved());
        const Tree& tree = builder->build(input, bench().queue);
        ASSERT_EQ(broken_promise(tree.spelled_out(), mesh.points, mesh.faces), "");
        expect_literal(dynamic_cast<const WideTree&>(tree), expected, GetParam());
        bench().queue.finish();
    }
};

TEST_P(Wide, IsLiteralOfSmallTrees)
{
    for (const uint triangles : {1u, 2u, 3u, 4u, 5u, 7u, 8u, 9u, 16u, 17u, 63u, 64u, 65u, 300u})
        for (const bool sorted : {false, true})
            for (const unsigned group_size : {0u, 8u, 64u})
                expect_at(triangles, 1, {.group_size = group_size, .sorted_leaves = sorted});
}

TEST_P(Wide, IsLiteralOfLargeTreesAndOfOddNumbers)
{
    for (const unsigned group_size : {0u, 64u, 512u}) {
        for (const uint triangles : {511u, 512u, 513u, 4095u, 4097u, 40000u})
            expect_at(triangles, 1, {.group_size = group_size});
        for (const float size : {1e-38f, 1e-42f, 1e30f, 3e38f})
            expect_at(1000, size, {.group_size = group_size});
    }
}

TEST_P(Wide, RefusesMoreTrianglesThanItHasLabelsFor)
{
    const auto builder = GetParam().make(bench().programs, {});
    EXPECT_THROW(builder->footprint((std::size_t{1} << 30) + 1), Unavailable);
}

TEST_P(Wide, TakesLessThanTheBinaryTree)
{
    const std::size_t triangles = 100000;
    const auto binary = make_oibvh_multi(bench().programs, {});
    const auto wide = GetParam().make(bench().programs, {});
    const double bytes = static_cast<double>(wide->footprint(triangles).tree_bytes) / triangles;
    EXPECT_LT(bytes, static_cast<double>(binary->footprint(triangles).tree_bytes) / triangles);
    EXPECT_NEAR(bytes,
                GetParam().on_grid     ? 28 + 64 / 7.0
                : GetParam().bits == 2 ? 36
                                       : 4 + 192 / 7.0,
                0.1);
}

INSTANTIATE_TEST_SUITE_P(Ways, Wide, testing::ValuesIn(ways),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace bvhbench
