// SPDX-License-Identifier: MIT
//
// Pairs of a class are exactly what the class says: checked in whole numbers, because all of these coordinates are whole.
#include "scenes/generate/pair_classes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "geometry/error.h"
#include "scenes/generate/vector.h"

namespace bvhbench {
namespace {

constexpr uint pairs = 3'000;

Vector whole(Point p, float of_half)
{
    const Vector w = {p.x, p.y, p.z - of_half};
    for (const double x : {w.x, w.y, w.z})
        EXPECT_EQ(x, std::round(x));
    return w;
}

double volume(Vector a, Vector b, Vector c, Vector d) { return dot(d - a, cross(b - a, c - a)); }

/// Returns the orientation of a, b, c seen along z.
double turn(Vector a, Vector b, Vector c) { return cross(b - a, c - a).z; }

/// Returns p with its coordinate `axis` in the place of z.
Vector seen_along(std::size_t axis, Vector p)
{
    const double along[] = {p.x, p.y, p.z};
    return {along[(axis + 1) % 3], along[(axis + 2) % 3], 0};
}

using Three = std::array<Vector, 3>;

/// True if the line of an edge of `a` separates `a` from `b`; unless `strictly`, `b` may touch the line.
bool parts(const Three& a, const Three& b, bool strictly)
{
    const double way = turn(a[0], a[1], a[2]) < 0 ? -1 : 1;
    for (std::size_t i = 0; i < 3; ++i)
        if (std::all_of(b.begin(), b.end(), [&](Vector p) {
                const double side = way * turn(a[i], a[(i + 1) % 3], p);
                return strictly ? side < 0 : side <= 0;
            }))
            return true;
    return false;
}

bool is_strictly_within(const Three& a, Vector p)
{
    const double way = turn(a[0], a[1], a[2]) < 0 ? -1 : 1;
    return way * turn(a[0], a[1], p) > 0 && way * turn(a[1], a[2], p) > 0 &&
           way * turn(a[2], a[0], p) > 0;
}

struct SixWholes {
    Three a, b;
};

std::vector<SixWholes> wholes_of(const char* name, float of_half = 0)
{
    const Mesh mesh = apart_pairs(find_pair_class(name), pairs, 7);
    std::vector<SixWholes> all(pairs);
    for (std::size_t k = 0; k < pairs; ++k)
        for (std::size_t c = 0; c < 3; ++c) {
            all[k].a[c] = whole(mesh.points[6 * k + c], of_half);
            all[k].b[c] = whole(mesh.points[6 * k + 3 + c], of_half);
        }
    return all;
}

std::vector<SixWholes> coplanar(const char* name)
{
    std::vector<SixWholes> all = wholes_of(name, 0.5f);
    for (const SixWholes& six : all)
        for (const Three& three : {six.a, six.b})
            for (const Vector p : three)
                EXPECT_EQ(p.z, p.x + 2 * p.y);
    return all;
}

TEST(PairClasses, AreAtLeastTwentyOfDifferentNames)
{
    std::set<std::string> names;
    for (const PairClass& one : pair_classes()) {
        names.insert(one.name);
        EXPECT_EQ(&find_pair_class(one.name), &one);
        EXPECT_FALSE(one.summary.empty());
    }
    EXPECT_EQ(names.size(), pair_classes().size());
    EXPECT_GE(names.size(), 20u);
    EXPECT_THROW(find_pair_class("easy"), BadUsage);
}

TEST(PairClasses, AreFiniteAndTheSameForASeedAndOthersForAnother)
{
    const auto bytes = [](const Mesh& mesh) { return mesh.points.size() * sizeof(Point); };
    for (const PairClass& of : pair_classes()) {
        SCOPED_TRACE(of.name);
        const Mesh one = apart_pairs(of, 200, 5), again = apart_pairs(of, 200, 5);
        const Mesh other = apart_pairs(of, 200, 6);
        EXPECT_EQ(one.faces.size(), 400u);
        EXPECT_EQ(std::memcmp(one.points.data(), again.points.data(), bytes(one)), 0);
        EXPECT_NE(std::memcmp(one.points.data(), other.points.data(), bytes(one)), 0);
        for (const Point p : one.points)
            EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
        for (const Face face : one.faces)
            EXPECT_TRUE(face.a + 1 == face.b && face.b + 1 == face.c);
    }
}

TEST(PairClasses, InOnePlaneTouchOverlapOrMissExactly)
{
    for (const SixWholes& six : coplanar("coplanar_disjoint"))
        EXPECT_TRUE(parts(six.a, six.b, true) || parts(six.b, six.a, true) ||
                    turn(six.a[0], six.a[1], six.a[2]) == 0 ||
                    turn(six.b[0], six.b[1], six.b[2]) == 0);
    for (const SixWholes& six : coplanar("coplanar_touching")) {
        EXPECT_FALSE(parts(six.a, six.b, true) || parts(six.b, six.a, true));
        EXPECT_TRUE(parts(six.a, six.b, false) || parts(six.b, six.a, false));
    }
    for (const SixWholes& six : coplanar("coplanar_overlapping"))
        EXPECT_FALSE(parts(six.a, six.b, false) || parts(six.b, six.a, false));
    for (const SixWholes& six : coplanar("coplanar_nested")) {
        const auto holds = [](const Three& out, const Three& in) {
            return std::all_of(in.begin(), in.end(),
                               [&](Vector p) { return is_strictly_within(out, p); });
        };
        EXPECT_TRUE(holds(six.a, six.b) || holds(six.b, six.a));
    }
}

/// True if a corner of `b` lies in the plane of `a`, within `a` as seen along some axis, and no part of `b` is below the plane.
bool stands_on(const Three& a, const Three& b)
{
    std::array<double, 3> heights;
    for (std::size_t c = 0; c < 3; ++c)
        heights[c] = volume(a[0], a[1], a[2], b[c]);
    const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
    if (*low < 0 && *high > 0)
        return false;
    for (std::size_t c = 0; c < 3; ++c) {
        if (heights[c] != 0)
            continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto seen = [&](Vector point) { return seen_along(axis, point); };
            if (is_strictly_within({seen(a[0]), seen(a[1]), seen(a[2])}, seen(b[c])))
                return true;
        }
    }
    return false;
}

TEST(PairClasses, WithACornerOnAFaceTouchThereExactly)
{
    for (const SixWholes& six : wholes_of("vertex_on_face"))
        EXPECT_TRUE(stands_on(six.a, six.b) || stands_on(six.b, six.a));
}

/// True if edge i of `a` and edge j of `b` cross in their interiors.
bool cross(const Three& a, std::size_t i, const Three& b, std::size_t j)
{
    const Vector p = a[i], q = a[(i + 1) % 3], r = b[j], s = b[(j + 1) % 3];
    if (volume(p, q, r, s) != 0)
        return false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto seen = [&](Vector point) { return seen_along(axis, point); };
        const auto opposite = [&](Vector from, Vector to, Vector one, Vector other) {
            return turn(seen(from), seen(to), seen(one)) * turn(seen(from), seen(to), seen(other)) <
                   0;
        };
        if (opposite(p, q, r, s) && opposite(r, s, p, q))
            return true;
    }
    return false;
}

TEST(PairClasses, WithCrossingEdgesTouchThereExactly)
{
    for (const SixWholes& six : wholes_of("edge_crosses_edge")) {
        int crossings = 0;
        for (std::size_t k = 0; k < 9; ++k)
            crossings += cross(six.a, k / 3, six.b, k % 3) ? 1 : 0;
        EXPECT_GE(crossings, 1);
    }
}

TEST(PairClasses, WithCornersAtOnePlaceHaveThemThereBitForBit)
{
    const auto common = [](const char* name) {
        const Mesh mesh = apart_pairs(find_pair_class(name), pairs, 7);
        std::set<std::size_t> counts;
        for (std::size_t k = 0; k < pairs; ++k) {
            std::size_t count = 0;
            for (std::size_t c = 0; c < 9; ++c)
                count += std::memcmp(&mesh.points[6 * k + c / 3], &mesh.points[6 * k + 3 + c % 3],
                                     sizeof(Point)) == 0
                             ? 1
                             : 0;
            counts.insert(count);
        }
        return counts;
    };
    EXPECT_EQ(common("same_place"), std::set<std::size_t>{1});
    EXPECT_EQ(common("shared_edge"), std::set<std::size_t>{2});
    EXPECT_EQ(common("identical"), std::set<std::size_t>{3});
}

TEST(PairClasses, InParallelPlanesAreOneStepApart)
{
    const Mesh mesh = apart_pairs(find_pair_class("parallel_planes"), pairs, 7);
    for (std::size_t k = 0; k < mesh.points.size(); ++k) {
        const Point p = mesh.points[k];
        EXPECT_EQ(double{p.z} - double{p.x} - 2 * double{p.y} - 0.5, k % 6 < 3 ? 0 : 0x1p-19);
    }
}

}  // namespace
}  // namespace bvhbench
