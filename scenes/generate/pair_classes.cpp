// SPDX-License-Identifier: MIT
#include "scenes/generate/pair_classes.h"

#include <cmath>
#include <limits>
#include <vector>

#include "geometry/names.h"
#include "scenes/generate/exact_pairs.h"
#include "scenes/generate/vector.h"

namespace bvhbench {
namespace {

// For most classes it is not known beforehand which pairs meet, because their coordinates are rounded without control.

constexpr float Point::*axes[] = {&Point::x, &Point::y, &Point::z};

Point beside(Point p, Dice& dice) { return p + 1e-6f * dice.point(); }

/// Returns p reflected through `centre`.
Point through(Point centre, Point p) { return 2 * centre - p; }

Point between(Point a, Point b, float t) { return a + t * (b - a); }

/// Returns `x` moved by `steps` floats, towards minus infinity if negative.
float some_steps(float x, int steps)
{
    constexpr float end = std::numeric_limits<float>::infinity();
    for (; steps != 0; steps += steps < 0 ? 1 : -1)
        x = std::nextafter(x, steps < 0 ? -end : end);
    return x;
}

SixPoints near_touching_six(Dice& dice)
{
    SixPoints six = generic_six(dice);
    double u = dice.unit(), v = dice.unit();
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    for (const auto c : axes) {
        const double x = six[0].*c + u * (six[1].*c - six[0].*c) + v * (six[2].*c - six[0].*c);
        six[3].*c = some_steps(static_cast<float>(x), dice.between(-2, 2));
    }
    return six;
}

SixPoints near_coplanar_six(Dice& dice)
{
    SixPoints six = coplanar_six(dice);
    Point& off = six[dice.below(6)];
    off.z = some_steps(off.z, dice.below(2) == 0 ? 1 : -1);
    return six;
}

SixPoints needle_six(Dice& dice)
{
    SixPoints six = generic_six(dice);
    six[1] = beside(six[0], dice);
    six[4] = beside(six[3], dice);
    six[5] = beside(through(between(six[0], six[2], 0.5f), six[3]), dice);
    return six;
}

SixPoints sliver_six(Dice& dice)
{
    SixPoints six = generic_six(dice);
    six[2] = beside(between(six[0], six[1], dice.unit()), dice);
    six[4] = beside(through(between(six[0], six[1], 0.5f), six[3]), dice);
    six[5] = beside(between(six[3], six[4], dice.unit()), dice);
    return six;
}

SixPoints hairs_breadth_six(Dice& dice)
{
    SixPoints six = lattice_six(dice, 3);
    for (Point& p : six) {
        p.z = p.x + 2 * p.y;
        for (const auto c : axes)
            if (p.*c == 0.0f)
                p.*c = static_cast<float>(dice.between(-1, 1)) * 1e-30f;
    }
    return six;
}

SixPoints twice_six(Dice& dice)
{
    SixPoints six = identical_six(dice);
    if (dice.below(2) == 0)
        six[3].x = some_steps(six[3].x, 1);
    return six;
}

SixPoints any_size_six(Dice& dice)
{
    SixPoints six;
    for (Point& p : six)
        for (const auto c : axes)
            do
                p.*c = as_float(dice.word());
            while (!std::isfinite(p.*c));
    return six;
}

SixPoints huge_and_small_six(Dice& dice)
{
    SixPoints six = near_touching_six(dice);
    for (std::size_t k = 4; k < 6; ++k)
        six[k] = six[3] + 1e-6f * (dice.point() - Point{0.5f, 0.5f, 0.5f});
    return six;
}

SixPoints flat_and_small_six(Dice& dice)
{
    SixPoints six = generic_six(dice);
    for (Point& p : six)
        p.z *= 1e-12f;
    return six;
}

using Six = std::function<SixPoints(Dice&)>;

/// Returns `six` with `change(Point) -> Point` applied to each point.
template <class Change>
Six changed(Six six, Change change)
{
    return [six = std::move(six), change](Dice& dice) {
        SixPoints points = six(dice);
        for (Point& point : points)
            point = change(point);
        return points;
    };
}

Six scaled_six(Six six, float scale)
{
    return changed(std::move(six), [scale](Point p) { return scale * p; });
}

Six moved_six(Six six, float by)
{
    return changed(std::move(six), [by](Point p) { return p + Point{by, by, -by}; });
}

Six lattice(uint cells)
{
    return [cells](Dice& dice) { return lattice_six(dice, cells); };
}

std::vector<PairClass> all_classes()
{
    using enum Meeting;
    std::vector<PairClass> classes = {
        {"generic", "any corners in the unit cube", generic_six},
        {"near_touching", "a corner within two float steps of the other's face", near_touching_six},
        {"coplanar_lattice", "small whole numbers, in one slanting plane", coplanar_six},
        {"near_coplanar", "the same, one corner moved a float step", near_coplanar_six},
        {"lattice_8", "whole numbers below 8", lattice(8)},
        {"lattice_3", "whole numbers below 3", lattice(3)},
        {"needles", "an edge of 1e-6, through or close by the other's middle", needle_six},
        {"slivers", "three corners all but in a line, through or close by the other's middle",
         sliver_six},
        {"hairs_breadth", "in one plane but for 1e-30", hairs_breadth_six},
        {"same_place", "a corner at the place of the other's: a shared vertex", same_place_six,
         all},
        {"shared_edge", "two corners at the places of the other's", shared_edge_six, all},
        {"twice", "the same triangle, half of the time with one corner a float step off",
         twice_six},
        {"identical", "the same triangle in another order of corners", identical_six, all},
        {"vertex_on_face", "a corner within the other's face, exactly, and on one side",
         vertex_on_face_six, all},
        {"edge_crosses_edge", "edges that cross exactly, all else apart", edge_crosses_edge_six,
         all},
        {"coplanar_overlapping", "in one plane, a common inner point", coplanar_overlapping_six,
         all},
        {"coplanar_touching", "in one plane, a corner on the other's edge and beyond it",
         coplanar_touching_six, all},
        {"coplanar_disjoint", "in one plane, a line of it in between", coplanar_disjoint_six, none},
        {"coplanar_nested", "in one plane, one within the other", coplanar_nested_six, all},
        {"parallel_planes", "in planes one float step apart", parallel_planes_six, none},
        {"degenerate", "segments and points among triangles, on few places", degenerate_six},
        {"points", "a point on or near a triangle, on few places", point_six},
        {"collinear", "two segments of one line", collinear_six},
        {"any_size", "any finite floats", any_size_six},
        {"huge_and_small", "one a million times as large as the other", huge_and_small_six},
        {"flat_and_small", "heights of 1e-12", flat_and_small_six},
        {"translated_1e3", "near_touching, moved by 1e3 and rounded",
         moved_six(near_touching_six, 1e3f)},
        {"translated_1e5", "the same by 1e5", moved_six(near_touching_six, 1e5f)},
        {"translated_1e8", "the same of 1e4 times the size, by 1e8",
         moved_six(scaled_six(near_touching_six, 1e4f), 1e8f)},
        {"lattice_2^20", "lattice_8, moved by 2^20: exact", moved_six(lattice(8), 0x1p20f)},
        {"denormals", "whole multiples of the least float", scaled_six(lattice(9), 1.4e-45f)},
        {"small_and_denormal", "near_touching times 1e-37", scaled_six(near_touching_six, 1e-37f)},
        {"largest", "near_touching times 3.4e38", scaled_six(near_touching_six, 3.4e38f)},
    };
    // Includes scales at which products of three floats reach the limits of the float range, at both ends.
    for (const auto& [name, scale] : {std::pair{"1e-30", 1e-30f},
                                      {"1e-20", 1e-20f},
                                      {"1e-16", 1e-16f},
                                      {"1e-15", 1e-15f},
                                      {"1e-14", 1e-14f},
                                      {"1e-13", 1e-13f},
                                      {"1e-4", 1e-4f},
                                      {"1e10", 1e10f},
                                      {"4e12", 4e12f},
                                      {"7e12", 7e12f},
                                      {"1e13", 1e13f},
                                      {"1e20", 1e20f},
                                      {"1e30", 1e30f}})
        classes.push_back({std::string("scaled_") + name,
                           std::string("near_touching times ") + name,
                           scaled_six(near_touching_six, scale)});
    return classes;
}

}  // namespace

std::span<const PairClass> pair_classes()
{
    static const std::vector<PairClass> classes = all_classes();
    return classes;
}

const PairClass& find_pair_class(std::string_view name)
{
    return find_called(pair_classes(), name, "class of pairs");
}

Mesh apart_pairs(const PairClass& of, uint count, uint seed)
{
    Dice dice(seed);
    Mesh mesh;
    mesh.points.reserve(6ul * count);
    mesh.faces.reserve(2ul * count);
    for (uint k = 0; k < count; ++k) {
        const SixPoints six = of.six(dice);
        mesh.points.insert(mesh.points.end(), six.begin(), six.end());
        mesh.faces.insert(mesh.faces.end(),
                          {{6 * k, 6 * k + 1, 6 * k + 2}, {6 * k + 3, 6 * k + 4, 6 * k + 5}});
    }
    return mesh;
}

}  // namespace bvhbench
