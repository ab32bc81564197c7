// SPDX-License-Identifier: MIT
//
// Box formats: rounding keeps the order and only enlarges boxes, for all inputs, and device and host round identically.
#include "builders/box_format.h"

#include <cmath>

#include "builders/stages/bounds.h"
#include "builders/stages/gather.h"
#include "tests/builders/stage_testing.h"

namespace bvhbench {
namespace {

constexpr float largest = std::numeric_limits<float>::max();
constexpr float denormal = std::numeric_limits<float>::denorm_min();

/// Returns numbers at which rounding, subtraction or scaling may fail, in ascending order.
std::vector<float> hard_numbers()
{
    std::vector<float> positive = {
        denormal,        3 * denormal, 0x1p-126f,       0x1p-126f - denormal,
        1e-30f,          1e-20f,       1e-3f,           0.1f,
        1.0f - 0x1p-24f, 1.0f,         1.0f + 0x1p-23f, 3.0f,
        65503.0f,        65504.0f,     65536.0f,        16777217.0f,
        1e20f,           1e30f,        0x1.fffffcp127f, largest};
    std::vector<float> all = {0.0f};
    for (const float x : positive) {
        all.push_back(x);
        all.push_back(-x);
    }
    std::sort(all.begin(), all.end());
    return all;
}

Aabb along_x(float low, float high) { return {low, low, low, high, high, high}; }

/// Returns the value of a half from its bits, in units of the smallest half.
double half_of_bits(uint bits)
{
    const int exponent = static_cast<int>(bits >> 10);
    const double mantissa = bits & 1023u;
    return exponent == 0 ? mantissa : std::ldexp(1024 + mantissa, exponent - 1);
}

TEST(Halves, AreRoundedOutwardAtEachOfThemAndBetween)
{
    constexpr uint largest_half = 0x7bff;
    ASSERT_EQ(half_of_bits(largest_half), HALF_CELLS);
    for (uint bits = 0; bits <= largest_half; ++bits) {
        const double here = half_of_bits(bits);
        ASSERT_EQ(half_below(here), bits);
        ASSERT_EQ(half_above(here), bits);
        for (const bool is_upper : {false, true}) {
            ASSERT_EQ(half_of_cell(HALF_CELLS + here, is_upper), 0x8000u + bits);
            ASSERT_EQ(half_of_cell(HALF_CELLS - here, is_upper), 0x8000u - bits);
        }
        ASSERT_EQ(cell_of_side(BOX_F16, 0x8000u + bits), HALF_CELLS + here);
        ASSERT_EQ(cell_of_side(BOX_F16, 0x8000u - bits), HALF_CELLS - here);
        if (bits == largest_half)
            break;
        const double next = half_of_bits(bits + 1);
        for (const double between : {here + 1, std::floor((here + next) / 2), next - 1}) {
            if (between <= here || between >= next)
                continue;
            ASSERT_EQ(half_below(between), bits);
            ASSERT_EQ(half_above(between), bits + 1);
            ASSERT_EQ(half_of_cell(HALF_CELLS - between, false), 0x8000u - bits - 1);
            ASSERT_EQ(half_of_cell(HALF_CELLS - between, true), 0x8000u - bits);
        }
    }
}

class EachFormat : public testing::TestWithParam<BoxFormat> {};

TEST_P(EachFormat, KeepsTheOrderOfSidesAndRoundsThemOutward)
{
    const std::vector<float> numbers = hard_numbers();
    for (const float low : numbers)
        for (const float high : numbers) {
            if (high < low)
                continue;
            SCOPED_TRACE(std::to_string(low) + " to " + std::to_string(high));
            const auto rounding = BoxRounding::of_scene(GetParam(), along_x(low, high));
            std::vector<float> inside;
            std::copy_if(numbers.begin(), numbers.end(), std::back_inserter(inside),
                         [&](float x) { return low <= x && x <= high; });
            float lower_before = -std::numeric_limits<float>::infinity(),
                  upper_before = lower_before;
            for (const float x : inside) {
                const Aabb point = rounding(along_x(x, x));
                ASSERT_LE(point.min_x, x);
                ASSERT_GE(point.max_x, x);
                ASSERT_LE(lower_before, point.min_x);
                ASSERT_LE(upper_before, point.max_x);
                ASSERT_FALSE(std::signbit(point.min_x) && point.min_x == 0);
                lower_before = point.min_x;
                upper_before = point.max_x;
                if (GetParam().has_cells()) {
                    const double product = double{x} * rounding.cells.x.scale;
                    ASSERT_GE(std::floor(product) - rounding.cells.x.first, 0);
                    ASSERT_LE(std::ceil(product) - rounding.cells.x.first,
                              last_cell(GetParam().number));
                } else {
                    ASSERT_EQ(point.min_x, x);
                    ASSERT_EQ(point.max_x, x);
                }
            }
        }
}

/// The stored sides must compare like the coordinates that they were made from, or comparisons would be wrong.
TEST_P(EachFormat, ComparesAndMergesWhatIsStoredAsWhatItMeans)
{
    if (!GetParam().has_cells())
        return;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> anywhere(-3.0f, 5.0f);
    const auto rounding = BoxRounding::of_scene(GetParam(), along_x(-3.0f, 5.0f));
    const auto side = [&](float x, bool is_upper) {
        return side_in(GetParam().number, rounding.cells.x, x, is_upper);
    };
    for (int k = 0; k < 20000; ++k) {
        const float x = anywhere(random), y = k % 3 == 0 ? x : anywhere(random);
        if (x <= y) {
            ASSERT_LE(side(x, false), side(y, true)) << "a pair would be missed";
            ASSERT_LE(side(x, false), side(y, false));
            ASSERT_LE(side(x, true), side(y, true));
        }
        const Aabb a = along_x(std::min(x, y), x), b = along_x(y, std::max(x, y));
        ASSERT_TRUE(same_bits(std::vector{rounding(merged(a, b))},
                              std::vector{merged(rounding(a), rounding(b))}));
    }
}

/// Along each axis, a rounded box may be too large by two cells, or for halves by slightly more than one part in a thousand.
TEST_P(EachFormat, UsesNearlyAllOfItsNumbers)
{
    const uint number = GetParam().number;
    if (!GetParam().has_cells())
        return;
    for (const float length : {1.0f, 1.9f, 1e-30f, 3e30f}) {
        const auto rounding = BoxRounding::of_scene(GetParam(), along_x(0.0f, length));
        EXPECT_GT(cell_of(rounding.cells.x, length, true, 1e300), 0.99 * (last_cell(number) - 2));
    }
}

TEST_P(EachFormat, IsTheSameOnTheDevice)
{
    for (const KernelForm form : both_forms) {
        GatherStage gather(bench().programs, form, 16, GetParam());
        for (const auto& [name, mesh] : hard_meshes(333)) {
            SCOPED_TRACE(name + ", " + name_of(form));
            const std::vector<Aabb> boxes = face_boxes(mesh.points, mesh.faces);
            const Bounds bounds = host_bounds(boxes);
            const std::vector<uint> ids = shuffled_ids(boxes.size());
            const Buffer<std::byte> sorted =
                on_device(std::vector<std::byte>(boxes.size() * GetParam().box_bytes()));
            // As for two objects.
            const Buffer<Bounds> device_bounds = on_device(std::vector{bounds, empty_bounds()});
            reserve([&](Arena& arena) { gather.plan(arena, {sorted}, device_bounds); });
            gather.enqueue(on_device(boxes), on_device(ids), {}, bench().queue);
            bench().queue.finish();

            const auto rounding = BoxRounding::of_scene(GetParam(), bounds.scene);
            if (GetParam().has_cells()) {
                EXPECT_TRUE(same_bits(from_device(gather.cells()), std::vector{rounding.cells}));
            }
            std::vector<std::byte> expected;
            for (const uint id : ids) {
                const std::vector<std::byte> one = rounding.stored(boxes[id]);
                expected.insert(expected.end(), one.begin(), one.end());
            }
            EXPECT_TRUE(same_bits(from_device(sorted), expected));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Catalog, EachFormat,
                         testing::ValuesIn(box_formats().begin(), box_formats().end()), CaseName());

}  // namespace
}  // namespace bvhbench
