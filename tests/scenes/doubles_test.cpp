// SPDX-License-Identifier: MIT
//
// Files whose coordinates floats cannot hold: boxes overlap in the converted floats exactly if they overlap in doubles, unless
// conversion as-is is selected; files that floats hold are not changed.
#include "scenes/doubles.h"

#include <cmath>
#include <cstdio>

#include "helpers.h"
#include "kinds.h"
#include "scenes/formats/text.h"
#include "scenes/generate/derived.h"

namespace bvhbench {
namespace {

constexpr std::size_t triangles = 150;

/// Returns small triangles without shared vertices in a cube of side 4.
std::vector<WidePoint> soup_at(WidePoint at, double scale = 1)
{
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<WidePoint> points;
    for (std::size_t k = 0; k < triangles; ++k) {
        const WidePoint low = {4 * unit(random), 4 * unit(random), 4 * unit(random)};
        for (int corner = 0; corner < 3; ++corner)
            points.push_back({at.x + scale * (low.x + unit(random)),
                              at.y + scale * (low.y + unit(random)),
                              at.z + scale * (low.z + unit(random))});
    }
    return points;
}

const WidePoint far_off = {4500123.4, 512345.6, 118.7};

template <class P>
bool overlap(const P* a, const P* b)
{
    const auto apart = [&](auto axis) {
        const auto [low_a, high_a] = std::minmax({a[0].*axis, a[1].*axis, a[2].*axis});
        const auto [low_b, high_b] = std::minmax({b[0].*axis, b[1].*axis, b[2].*axis});
        return high_a < low_b || high_b < low_a;
    };
    return !apart(&P::x) && !apart(&P::y) && !apart(&P::z);
}

/// Returns the pairs of triangles whose boxes overlap, by comparing all pairs.
template <class P>
std::vector<std::pair<std::size_t, std::size_t>> pairs_of(const std::vector<P>& points)
{
    std::vector<std::pair<std::size_t, std::size_t>> found;
    for (std::size_t a = 0; a < triangles; ++a)
        for (std::size_t b = a + 1; b < triangles; ++b)
            if (overlap(&points[3 * a], &points[3 * b]))
                found.push_back({a, b});
    return found;
}

/// Rounds to float. The result is stored, because GCC 12.2 drops both conversions when it vectorises them.
double rounded(double x)
{
    const volatile float stored = static_cast<float>(x);
    return stored;
}

std::string number(double x, int digits = 17)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.*g", digits, x);
    return text;
}

template <class T>
std::string ply_of(const std::vector<WidePoint>& points, const char* type)
{
    std::string ply =
        "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points.size());
    for (const char* axis : {"x", "y", "z"})
        ply += std::string("\nproperty ") + type + ' ' + axis;
    ply += "\nelement face " + std::to_string(triangles) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
    const auto append = [&](auto value) {
        ply.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    for (const WidePoint& p : points) {
        append(static_cast<T>(p.x));
        append(static_cast<T>(p.y));
        append(static_cast<T>(p.z));
    }
    for (int k = 0; k < static_cast<int>(triangles); ++k) {
        append(static_cast<unsigned char>(3));
        for (int corner = 0; corner < 3; ++corner)
            append(3 * k + corner);
    }
    return ply;
}

/// Writes the triangles as text of each of three formats and returns the files' paths.
std::vector<std::string> text_files(const Folder& folder, const std::vector<WidePoint>& points)
{
    Model::Part part;
    for (const WidePoint& p : points)
        part.points.push_back({p.x, p.y, p.z});
    for (unsigned k = 0; k < points.size(); k += 3)
        part.faces.push_back({k, k + 1, k + 2});
    Chance plain{.is_plain = true};
    std::vector<std::string> paths;
    for (const std::string name : {"plain.obj", "plain.off", "plain.stl"}) {
        const auto kind = std::ranges::find(kinds(), name, &Kind::name);
        paths.push_back(folder.file(name, kind->write({{part}}, plain)));
    }
    return paths;
}

TEST(Doubles, AreSeenWhereDigitsSayMoreThanAFloatDoes)
{
    const auto held = [](std::string_view word) { return parse_number(word).value().floats_hold; };
    for (const char* word : {"0.1", "-0.1", "+12.50", "1e-3", "125e1", "0", "-0.0", "16777216e1",
                             "3.40282347e38", "1e400", "nan", "inf", "0.000000", "1e-400"})
        EXPECT_TRUE(held(word)) << word;
    for (const char* word : {"16777217", "4500123.45", "0.12345678901", "-1.0000000001", "1e39",
                             "4500123450e-3", "16777217.0", "1e-60"})
        EXPECT_FALSE(held(word)) << word;
    EXPECT_EQ(parse_number("4500123.45")->wide, 4500123.45);
    EXPECT_EQ(parse_number("4500123.45")->rounded, 4500123.5f);
    // Floats printed with any number of digits.
    std::mt19937 random(1);
    for (int k = 0; k < 20000; ++k) {
        const auto bits = static_cast<uint>(random());
        const float x = as_float(bits);
        if (!std::isfinite(x) || (bits & 0x7f800000u) == 0)
            continue;
        for (const int digits : {3, 6, 8, 9, 12, 17})
            EXPECT_TRUE(held(number(double{x}, digits))) << number(double{x}, 17) << ' ' << digits;
        char fixed[64];
        std::snprintf(fixed, sizeof fixed, "%.6f", double{x});
        EXPECT_TRUE(held(fixed)) << fixed;
    }
}

using DoublesInFiles = InFolder;

TEST_F(DoublesInFiles, OfFloatsAreLeftAlone)
{
    std::vector<WidePoint> points = soup_at(far_off);
    for (WidePoint& p : points)
        p = {rounded(p.x), rounded(p.y), rounded(p.z)};
    Listening library;
    const Scene narrow = load_scene(folder.file("f.ply", ply_of<float>(points, "float")), library);
    const auto same = [&](const std::string& path) {
        const Scene scene = load_scene(path, library);
        EXPECT_FALSE(scene.rounding.how) << path;
        EXPECT_EQ(scene.content_hash, narrow.content_hash) << path;
    };
    same(folder.file("d.ply", ply_of<double>(points, "double")));
    std::ranges::for_each(text_files(folder, points), same);
    EXPECT_EQ(library.told.find("doubles"), library.told.npos) << library.told;
    EXPECT_TRUE(contains(library.told, "floats are 0.5 apart at its largest coordinate"));
}

TEST_F(DoublesInFiles, FarOffAreRecentredSoThatTheSamePairsOverlap)
{
    const std::vector<WidePoint> points = soup_at(far_off);
    const auto right = pairs_of(points);
    ASSERT_GT(right.size(), 50u);
    Listening library;
    const Scene scene = load_scene(folder.file("d.ply", ply_of<double>(points, "double")), library);
    EXPECT_EQ(scene.rounding.how, Doubles::recentred);
    EXPECT_EQ(pairs_of(scene.frames[0]), right);
    EXPECT_EQ(scene.rounding.scale_log2, 0);
    EXPECT_NEAR(scene.rounding.offset.x, far_off.x + 2.5, 1);
    EXPECT_GT(scene.rounding.rounded_count, 2 * points.size());
    EXPECT_GT(scene.rounding.largest_error, 1e-9);
    EXPECT_LT(scene.rounding.largest_error, 5e-7);
    EXPECT_TRUE(
        contains(library.told,
                 "d.ply': coordinates moved by at most 2e-07: doubles, as floats around (4.5e+06"));
    for (std::size_t k = 0; k < points.size(); ++k)
        EXPECT_LE(std::fabs(scene.rounding.offset.x + scene.frames[0][k].x - points[k].x),
                  scene.rounding.largest_error);
    // All text formats give the same result.
    for (const std::string& path : text_files(folder, points)) {
        const Scene text = load_scene(path, {});
        EXPECT_EQ(text.content_hash, scene.content_hash) << path;
        EXPECT_EQ(text.rounding.largest_error, scene.rounding.largest_error) << path;
    }
    library.doubles = Doubles::as_is;
    const Scene as_is = load_scene(path() + "/d.ply", library);
    EXPECT_EQ(as_is.rounding.how, Doubles::as_is);
    EXPECT_EQ(as_is.rounding.offset.x, 0);
    EXPECT_GT(as_is.rounding.largest_error, 0.1);  // floats are half a unit apart at this distance
    EXPECT_EQ(as_is.frames[0][0].x, static_cast<float>(points[0].x));
    const auto found = pairs_of(as_is.frames[0]);
    EXPECT_GT(found.size(), right.size() + right.size() / 10);
    EXPECT_TRUE(std::includes(found.begin(), found.end(), right.begin(), right.end()));
    EXPECT_TRUE(contains(library.told, "at most 0.3: doubles, as floats; "));
}

TEST_F(DoublesInFiles, BeyondTheFloatsAreScaledByAPowerOfTwo)
{
    for (const double scale : {0x1p900, 0x1p-900, 0x1p-120, 0x1p127}) {
        SCOPED_TRACE(scale);
        const std::vector<WidePoint> points = soup_at({0, 0, 0}, scale);
        const Scene scene = loaded("d.ply", ply_of<double>(points, "double"));
        EXPECT_EQ(pairs_of(scene.frames[0]), pairs_of(points));
        EXPECT_NE(scene.rounding.scale_log2, 0);
        EXPECT_LT(scene.rounding.largest_error, 1e-6 * scale);
        for (const Point& p : scene.frames[0])
            EXPECT_LE(std::fabs(p.x), 2);
    }
    std::vector<WidePoint> points = soup_at(far_off);
    points[7].y = INFINITY;
    EXPECT_TRUE(refuses(folder.file("i.ply", ply_of<double>(points, "double")),
                        "a vertex, 7, that is not finite in float32"));
}

/// What is at rest in all frames remains so, although one of the files alone would not be changed.
TEST_F(DoublesInFiles, OfASequenceShareOneOffset)
{
    const std::string faces = "f 1 2 3\nf 4 5 6\n",
                      still = "v 12.1 7.3 1\nv 13.1 7.3 1\nv 12.1 8.3 1\n";
    folder.file("a0.obj", still + "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + faces);
    folder.file("a1.obj",
                still + "v 3000000.25 0 0\nv 3000001.3125 0 0\nv 3000000.1234567 1 0\n" + faces);
    EXPECT_FALSE(load_scene(path() + "/a0.obj", {}).rounding.how);
    const Scene scene = load_scene(path(), {});
    EXPECT_EQ(scene.rounding.how, Doubles::recentred);
    EXPECT_NEAR(scene.rounding.offset.x, 1500000.65, 0.01);
    ASSERT_EQ(scene.frames.size(), 2u);
    EXPECT_EQ(std::memcmp(scene.frames[0].data(), scene.frames[1].data(), 3 * sizeof(Point)), 0);
    EXPECT_EQ(scene.frames[0][0].x, static_cast<float>(12.1 - scene.rounding.offset.x));
}

TEST_F(DoublesInFiles, KeptForStepsAreMovedExactlyAndLostByNoChange)
{
    std::vector<WidePoint> points = soup_at(far_off);
    points[1] = points[0];
    const std::string alone = folder.file("a0.ply", ply_of<double>(points, "double"));
    for (WidePoint& p : points)
        p.z += 1e-3;
    folder.file("a1.ply", ply_of<double>(points, "double"));
    Listening library;
    library.doubles = Doubles::kept;
    const Scene scene = load_scene(path(), library);
    EXPECT_TRUE(contains(library.told, ", and kept for steps between frames"));
    ASSERT_EQ(scene.wide.size(), 2u);
    const WidePoint by = scene.rounding.offset;
    EXPECT_NEAR(by.y, far_off.y, 10);
    for (std::size_t k = 0; k < points.size(); ++k) {
        EXPECT_EQ(scene.wide[1][k].y + by.y, points[k].y);
        EXPECT_EQ(scene.wide[1][k].z + by.z, points[k].z);
        EXPECT_EQ(scene.frames[1][k].z, rounded(scene.wide[1][k].z));
    }
    points[0].x = std::nextafter(points[0].x, 0);
    folder.file("a1.ply", ply_of<double>(points, "double"));
    const Scene other = load_scene(path(), library);
    EXPECT_EQ(scene.frames[1][0].x, other.frames[1][0].x);
    EXPECT_NE(scene.content_hash, other.content_hash);
    points[0].x = 0.1;  // now no offset is exact
    folder.file("a1.ply", ply_of<double>(points, "double"));
    EXPECT_EQ(load_scene(path(), library).rounding.offset.x, 0);

    const std::string why = "has doubles that cannot be kept";
    for (const std::string& name :
         {"bend:" + alone, "refine:" + alone + ":200", "outlier:" + alone + ":9:1"})
        EXPECT_TRUE(refuses(name, why, library));
    library.weld = true;
    EXPECT_TRUE(refuses(alone, why, library));
    EXPECT_THROW(with_frames_between(scene, 1), Unavailable);
}

}  // namespace
}  // namespace bvhbench
