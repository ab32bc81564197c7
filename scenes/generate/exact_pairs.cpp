// SPDX-License-Identifier: MIT
#include <utility>

#include "scenes/generate/exact_pairs.h"
#include "scenes/generate/vector.h"

namespace bvhbench {
namespace {

// Vectors in this file hold whole numbers up to a few thousand, so all arithmetic is exact.

/// Returns a vector with coordinates from -size to size.
Vector any_whole(Dice& dice, int size)
{
    const double x = dice.between(-size, size), y = dice.between(-size, size);
    return {x, y, static_cast<double>(dice.between(-size, size))};
}

Vector any_flat(Dice& dice, int size)
{
    const double x = dice.between(-size, size);
    return {x, static_cast<double>(dice.between(-size, size)), 0};
}

/// Divides a vector whose coordinates are multiples of `by`.
Vector divided(Vector a, double by) { return {a.x / by, a.y / by, a.z / by}; }

using SixVectors = std::array<Vector, 6>;

/// Returns the triangles in space, the corners of each in random order, either triangle first.
SixPoints stored_in_any_order(SixVectors six, Dice& dice)
{
    for (const std::size_t at : {0u, 3u}) {
        std::swap(six[at], six[at + dice.below(3)]);
        std::swap(six[at + 1], six[at + 1 + dice.below(2)]);
    }
    const std::size_t first = 3 * dice.below(2);
    SixPoints points;
    for (std::size_t k = 0; k < 6; ++k)  // -0 + 0 is +0
        points[k] = rounded(six[(k + first) % 6] + Vector{});
    return points;
}

/// Maps points from the plane z = 0 to the plane of coplanar_six.
SixPoints raised(SixPoints six)
{
    for (Point& p : six)
        p.z = p.x + 2 * p.y + 0.5f;
    return six;
}

double area(Vector a, Vector b, Vector c) { return cross(b - a, c - a).z; }

/// Returns a triangle with positive area in the plane z = 0 whose coordinates are multiples of `step`.
std::array<Vector, 3> flat_triangle(Dice& dice, int size, int step)
{
    std::array<Vector, 3> three;
    do
        for (Vector& p : three)
            p = step * any_flat(dice, size);
    while (area(three[0], three[1], three[2]) == 0);
    return three;
}

}  // namespace

SixPoints generic_six(Dice& dice)
{
    SixPoints six;
    for (Point& p : six)
        p = dice.point();
    return six;
}

SixPoints lattice_six(Dice& dice, uint cells)
{
    SixPoints six;
    for (Point& p : six)
        p = dice.lattice(cells);
    return six;
}

SixPoints coplanar_six(Dice& dice) { return raised(lattice_six(dice, 8)); }

/// The first triangle's centroid is also that of the second, hence inside both.
SixPoints coplanar_overlapping_six(Dice& dice)
{
    const auto [a, b, c] = flat_triangle(dice, 7, 3);
    const Vector centroid = divided(a + b + c, 3);
    Vector u, v;
    do {
        u = any_flat(dice, 12);
        v = any_flat(dice, 12);
    } while (cross(u, v).z == 0);
    const Vector w = -1 * (u + v);
    return raised(stored_in_any_order({a, b, c, centroid + u, centroid + v, centroid + w}, dice));
}

/// One corner of the second lies on an edge of the first; its other corners are not on the first's side of that edge.
SixPoints coplanar_touching_six(Dice& dice)
{
    const auto [a, b, c] = flat_triangle(dice, 7, 4);
    const Vector quarter = divided(b - a, 4);
    const Vector on_edge = a + dice.between(0, 4) * quarter;
    const auto beyond = [&, a = a, b = b, c = c] {
        const Vector off = any_flat(dice, 12);
        const bool is_inside = (area(a, b, on_edge + off) > 0) == (area(a, b, c) > 0);
        return on_edge + (is_inside ? -1 : 1) * off;
    };
    const Vector second = beyond();
    return raised(stored_in_any_order({a, b, c, on_edge, second, beyond()}, dice));
}

/// The triangles lie on different sides of a strip of the lattice, which is then sheared.
SixPoints coplanar_disjoint_six(Dice& dice)
{
    SixVectors six;
    const int shear = dice.between(-3, 3), lean = dice.between(-3, 3);
    for (std::size_t k = 0; k < 6; ++k) {
        const double x = k < 3 ? dice.between(-7, 0) : dice.between(1, 8);
        const double y = dice.between(-7, 7), sheared = x + shear * y;
        six[k] = {sheared, y + lean * sheared, 0};
    }
    return raised(stored_in_any_order(six, dice));
}

/// The second triangle is the first, shrunk to a half or a quarter around its centroid.
SixPoints coplanar_nested_six(Dice& dice)
{
    const auto [a, b, c] = flat_triangle(dice, 7, 12);
    const Vector centroid = divided(a + b + c, 3);
    const int part = dice.below(2) == 0 ? 2 : 4;
    const auto within = [&](Vector p) { return centroid + divided(p - centroid, part); };
    return raised(stored_in_any_order({a, b, c, within(a), within(b), within(c)}, dice));
}

/// Adds one float step of the largest height, so that all three corners are raised by the same amount.
SixPoints parallel_planes_six(Dice& dice)
{
    SixPoints six = coplanar_six(dice);
    for (std::size_t k = 3; k < 6; ++k)
        six[k].z += 0x1p-19f;  // heights are below 32
    return six;
}

SixPoints same_place_six(Dice& dice)
{
    SixPoints six = generic_six(dice);
    const std::size_t to = 3 + dice.below(3);
    six[to] = six[dice.below(3)];
    return six;
}

SixPoints shared_edge_six(Dice& dice)
{
    SixPoints six = generic_six(dice);
    const std::size_t first = dice.below(3), second = dice.below(3);
    const bool is_turned = dice.below(2) == 0;
    six[3 + first] = six[second];
    six[3 + (first + 1) % 3] = six[(second + (is_turned ? 2 : 1)) % 3];
    return six;
}

SixPoints identical_six(Dice& dice)
{
    SixPoints six = generic_six(dice);
    const std::size_t first = dice.below(3);
    const bool is_turned = dice.below(2) == 0;
    for (std::size_t k = 0; k < 3; ++k)
        six[3 + k] = six[(is_turned ? first + 3 - k : first + k) % 3];
    return six;
}

SixPoints vertex_on_face_six(Dice& dice)
{
    Vector a, b, c, normal;
    do {
        a = 4 * any_whole(dice, 8);
        b = 4 * any_whole(dice, 8);
        c = 4 * any_whole(dice, 8);
        normal = cross(b - a, c - a);
    } while (dot(normal, normal) == 0);
    // Weights 2, 1, 1 of four, assigned to the corners in random order.
    const Vector sum = a + b + c;
    const std::array<Vector, 3> weighed = {sum + a, sum + b, sum + c};
    const Vector four = weighed[dice.below(3)];
    const Vector on_face = divided(four, 4);
    const auto above = [&] {
        const Vector off = any_whole(dice, 16);
        return on_face + (dot(normal, off) < 0 ? -1 : 1) * off;
    };
    const Vector second = above();
    return stored_in_any_order({a, b, c, on_face, second, above()}, dice);
}

SixPoints edge_crosses_edge_six(Dice& dice)
{
    Vector half, other, normal;
    do {
        half = any_whole(dice, 8);
        other = any_whole(dice, 8);
        normal = cross(half, other);
    } while (dot(normal, normal) == 0);
    const Vector middle = any_whole(dice, 16);
    const auto on_side = [&](int side) {
        Vector off;
        do
            off = any_whole(dice, 16);
        while (dot(normal, off) == 0);
        return middle + ((dot(normal, off) > 0) == (side > 0) ? 1 : -1) * off;
    };
    const int before = dice.between(1, 3), behind = dice.between(1, 3);
    const Vector first = on_side(1);
    return stored_in_any_order({middle - half, middle + half, first, middle - before * other,
                                middle + behind * other, on_side(-1)},
                               dice);
}

SixPoints degenerate_six(Dice& dice)
{
    SixPoints six = lattice_six(dice, 3);
    for (const std::size_t at : {0u, 3u})
        switch (dice.below(4)) {
            case 0:
                six[at + 1] = six[at];
                break;
            case 1:
                six[at + 1] = six[at + 2] = six[at];
                break;
            case 2:  // three collinear corners
                six[at + 2] = 2 * six[at + 1] - six[at];
                break;
            default:
                break;
        }
    return six;
}

SixPoints point_six(Dice& dice)
{
    SixPoints six = lattice_six(dice, 4);
    const std::size_t at = 3 * dice.below(2);
    six[at + 1] = six[at + 2] = six[at];
    return six;
}

SixPoints collinear_six(Dice& dice)
{
    SixPoints six;
    for (Point& p : six) {
        const auto t = static_cast<float>(dice.below(12));
        p = {t, 2 * t, 1 - t};
    }
    return six;
}

}  // namespace bvhbench
