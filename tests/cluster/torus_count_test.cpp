// SPDX-License-Identifier: MIT
//
// Counts the pairs of a torus by where its quads lie, without a tree, a curve or a device: boxes of a smooth sheet of W x H quads meet
// only a few rows and columns apart. With BVHBENCH_TESTS=all also those of the largest tori of docs/cluster.md, which takes minutes.
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/cores.h"
#include "scenes/generate/generators.h"
#include "tests/all_cases.h"
#include "tests/brute_pairs.h"

namespace bvhbench {
namespace {

constexpr int columns_apart = 8, rows_apart = 16;  ///< no boxes meet that lie that far apart
constexpr std::size_t rows_a_task = 64;

typedef float Floats __attribute__((vector_size(32), aligned(4), may_alias));
typedef int Integers __attribute__((vector_size(32)));
constexpr std::size_t lanes = sizeof(Floats) / sizeof(float);

/// Sides of the boxes of one of a quad's two triangles, by quad of a row. The first columns stand again behind the last, and the other
/// way round.
struct RowOfBoxes {
    std::vector<float> sides[6];

    void put(std::size_t at, const Aabb& box)
    {
        const float values[6] = {box.min_x, box.min_y, box.min_z, box.max_x, box.max_y, box.max_z};
        for (int k = 0; k < 6; ++k)
            sides[k][at] = values[k];
    }
};

struct Row {
    RowOfBoxes of[2];
};

struct Torus {
    explicit Torus(uint count)
        : triangles(count)
        , quads((std::size_t{count} + 1) / 2)
        , width(static_cast<std::size_t>(std::sqrt(static_cast<double>(quads))) + 1)
        , height((quads + width - 1) / width)
    {}

    /// Returns rows `first` to `first` + `count` - 1, counted around the tube.
    std::vector<Row> rows(std::size_t first, std::size_t count) const
    {
        std::vector<Row> made;
        while (made.size() < count) {
            const std::size_t row = (first + made.size()) % height;
            append(made, row, std::min(count - made.size(), height - row));
        }
        return made;
    }

    uint triangles;
    std::size_t quads, width, height;

private:
    void append(std::vector<Row>& made, std::size_t row, std::size_t count) const
    {
        const std::size_t begin = 2 * width * row,
                          end = std::min<std::size_t>(begin + 2 * width * count, triangles);
        const MeshRun mesh =
            torus_run(triangles, {static_cast<uint>(begin), static_cast<uint>(end - begin)});
        const uint base = mesh.vertices.front();
        for (std::size_t k = 0; k < count; ++k) {
            Row& to = made.emplace_back();
            for (RowOfBoxes& boxes : to.of)
                for (auto& side : boxes.sides)  // no box overlaps one of NaN
                    side.assign(width + 2 * columns_apart + lanes,
                                std::numeric_limits<float>::quiet_NaN());
            for (std::size_t t = 2 * width * k; t < std::min(2 * width * (k + 1), end - begin);
                 ++t) {
                const Face face = mesh.faces[t];
                const Aabb box =
                    triangle_box(mesh.points[face.a - base], mesh.points[face.b - base],
                                 mesh.points[face.c - base]);
                const std::size_t column = t / 2 - width * k;
                RowOfBoxes& boxes = to.of[t % 2];
                boxes.put(column + columns_apart, box);
                if (column < columns_apart)
                    boxes.put(column + columns_apart + width, box);
                if (column + columns_apart >= width)
                    boxes.put(column + columns_apart - width, box);
            }
        }
    }
};

/// Returns how many boxes of `a` overlap those of `b` that lie `columns` further. Other functions of tests are hardly optimized.
[[gnu::optimize("O3")]] std::uint64_t count_overlaps(const RowOfBoxes& a, const RowOfBoxes& b,
                                                     std::size_t width, int columns)
{
    const float *one[6], *other[6];
    for (int side = 0; side < 6; ++side) {
        one[side] = &a.sides[side][columns_apart];
        other[side] = &b.sides[side][columns_apart + columns];
    }
    const auto some = [](const float* sides) { return *reinterpret_cast<const Floats*>(sides); };
    Integers found = {};
    Integers left = Integers{0, -1, -2, -3, -4, -5, -6, -7} + static_cast<int>(width);
    for (std::size_t i = 0; i < width; i += lanes) {
        Integers overlap = left > 0;  // -1 for yes
        for (int low = 0, high = 3; low < 3; ++low, ++high)
            overlap &= (some(one[low] + i) <= some(other[high] + i)) &
                       (some(other[low] + i) <= some(one[high] + i));
        found += overlap;
        left -= static_cast<int>(lanes);
    }
    std::uint64_t count = 0;
    for (std::size_t lane = 0; lane < lanes; ++lane)
        count += static_cast<uint>(-found[lane]);
    return count;
}

struct Counts {
    std::uint64_t pairs = 0, at_the_edge = 0;  ///< those as far apart as is looked at
};

Counts count_pairs(const Torus& torus)
{
    std::atomic<std::uint64_t> pairs = 0, at_the_edge = 0;
    on_all_cores((torus.height + rows_a_task - 1) / rows_a_task, [&](std::size_t task) {
        const std::size_t first = task * rows_a_task,
                          count = std::min(rows_a_task, torus.height - first);
        const std::vector<Row> rows = torus.rows(first, count + rows_apart);
        for (std::size_t row = 0; row < count; ++row)
            for (int down = 0; down <= rows_apart; ++down)
                for (int right = down == 0 ? 0 : -columns_apart; right <= columns_apart; ++right)
                    for (int one = 0; one < 2; ++one)
                        for (int other = 0; other < 2; ++other) {
                            if (down == 0 && right == 0 && one >= other)
                                continue;  // of a quad's own two triangles, once
                            const auto found = count_overlaps(
                                rows[row].of[one], rows[row + down].of[other], torus.width, right);
                            pairs += found;
                            if (down == rows_apart || std::abs(right) == columns_apart)
                                at_the_edge += found;
                        }
    });
    return {pairs, at_the_edge};
}

void expect_pairs(uint triangles, std::uint64_t pairs)
{
    const Counts counts = count_pairs(Torus(triangles));
    EXPECT_EQ(counts.pairs, pairs) << triangles;
    EXPECT_EQ(counts.at_the_edge, 0u) << triangles;
}

// Odd, so that a quad has one triangle; its last row is not full.
TEST(TorusCount, EqualsBruteForce)
{
    const uint triangles = 9001;
    const Mesh mesh = make_torus(triangles);
    expect_pairs(triangles, brute_pairs(face_boxes(mesh.points, mesh.faces)).size());
}

TEST(TorusCount, IsThatOfTrees) { expect_pairs(2'880'000, 18'320'089); }

TEST(TorusCount, IsThatOfSeveralDevices)
{
    if (!takes_all_cases())
        GTEST_SKIP() << "takes minutes";
    expect_pairs(660'000'000, 4'201'627'177);
    expect_pairs(1'000'000'000, 6'366'301'999);
    expect_pairs(2'147'483'648, 13'672'599'165);
}

}  // namespace
}  // namespace bvhbench
