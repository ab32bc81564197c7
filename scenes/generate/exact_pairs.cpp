// SPDX-License-Identifier: MIT
#include "scenes/generate/exact_pairs.h"

#include <utility>

#include "scenes/generate/rounded_pairs.h"

namespace bvhbench {
namespace {

/// A point of the lattice. No number here is larger than a few thousand.
struct Whole {
    int x = 0, y = 0, z = 0;

    friend Whole operator+(Whole a, Whole b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Whole operator-(Whole a, Whole b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Whole operator*(int k, Whole a) { return {k * a.x, k * a.y, k * a.z}; }
};

int dot(Whole a, Whole b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Whole cross(Whole a, Whole b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

bool is_zero(Whole a) { return a.x == 0 && a.y == 0 && a.z == 0; }

/// Each coordinate from -size to size.
Whole any_whole(Dice& dice, int size)
{
    const int x = dice.between(-size, size), y = dice.between(-size, size);
    return {x, y, dice.between(-size, size)};
}

Whole any_flat(Dice& dice, int size)
{
    const int x = dice.between(-size, size);
    return {x, dice.between(-size, size), 0};
}

using SixWholes = std::array<Whole, 6>;

Point stored(Whole p)
{
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

/// In space, the corners of each triangle in any order, either triangle first.
SixPoints stored_in_any_order(SixWholes six, Dice& dice)
{
    for (const std::size_t at : {0u, 3u}) {
        std::swap(six[at], six[at + dice.below(3)]);
        std::swap(six[at + 1], six[at + 1 + dice.below(2)]);
    }
    const std::size_t first = 3 * dice.below(2);
    SixPoints points;
    for (std::size_t k = 0; k < 6; ++k)
        points[k] = stored(six[(k + first) % 6]);
    return points;
}

/// From the plane z = 0 to the one of coplanar_six.
SixPoints raised(SixPoints six)
{
    for (Point& p : six)
        p.z = p.x + 2 * p.y + 0.5f;
    return six;
}

int area(Whole a, Whole b, Whole c) { return cross(b - a, c - a).z; }

/// Three points of the plane z = 0, multiples of `step`, with area.
std::array<Whole, 3> flat_triangle(Dice& dice, int size, int step)
{
    std::array<Whole, 3> three;
    do
        for (Whole& p : three)
            p = step * any_flat(dice, size);
    while (area(three[0], three[1], three[2]) == 0);
    return three;
}

}  // namespace

SixPoints lattice_six(Dice& dice, uint cells)
{
    SixPoints six;
    for (Point& p : six)
        p = dice.lattice(cells);
    return six;
}

SixPoints coplanar_six(Dice& dice) { return raised(lattice_six(dice, 8)); }

/// The first one's centroid is that of the second, too: inside of both.
SixPoints coplanar_overlapping_six(Dice& dice)
{
    const auto [a, b, c] = flat_triangle(dice, 7, 3);
    const Whole centroid = {(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, 0};
    Whole u, v;
    do {
        u = any_flat(dice, 12);
        v = any_flat(dice, 12);
    } while (cross(u, v).z == 0);
    const Whole w = -1 * (u + v);
    return raised(stored_in_any_order({a, b, c, centroid + u, centroid + v, centroid + w}, dice));
}

/// A corner on an edge of the first, the others not on that one's side of it.
SixPoints coplanar_touching_six(Dice& dice)
{
    const auto [a, b, c] = flat_triangle(dice, 7, 4);
    const Whole quarter = {(b.x - a.x) / 4, (b.y - a.y) / 4, 0};
    const Whole on_edge = a + dice.between(0, 4) * quarter;
    const auto beyond = [&, a = a, b = b, c = c] {
        const Whole off = any_flat(dice, 12);
        const bool is_inside = (area(a, b, on_edge + off) > 0) == (area(a, b, c) > 0);
        return on_edge + (is_inside ? -1 : 1) * off;
    };
    const Whole second = beyond();
    return raised(stored_in_any_order({a, b, c, on_edge, second, beyond()}, dice));
}

/// On two sides of a strip of the lattice, which is then sheared.
SixPoints coplanar_disjoint_six(Dice& dice)
{
    SixWholes six;
    const int shear = dice.between(-3, 3), lean = dice.between(-3, 3);
    for (std::size_t k = 0; k < 6; ++k) {
        const int x = k < 3 ? dice.between(-7, 0) : dice.between(1, 8);
        const int y = dice.between(-7, 7), sheared = x + shear * y;
        six[k] = {sheared, y + lean * sheared, 0};
    }
    return raised(stored_in_any_order(six, dice));
}

/// The second is the first one, shrunk to a half or a quarter around its centroid.
SixPoints coplanar_nested_six(Dice& dice)
{
    const auto [a, b, c] = flat_triangle(dice, 7, 12);
    const Whole centroid = {(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, 0};
    const int part = dice.below(2) == 0 ? 2 : 4;
    const auto within = [&](Whole p) {
        return Whole{centroid.x + (p.x - centroid.x) / part, centroid.y + (p.y - centroid.y) / part,
                     0};
    };
    return raised(stored_in_any_order({a, b, c, within(a), within(b), within(c)}, dice));
}

/// A step of the largest height, so that all three are lifted by as much.
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
    Whole a, b, c, normal;
    do {
        a = 4 * any_whole(dice, 8);
        b = 4 * any_whole(dice, 8);
        c = 4 * any_whole(dice, 8);
        normal = cross(b - a, c - a);
    } while (is_zero(normal));
    // Weights 2, 1, 1 of four, in any order of corners.
    const Whole sum = a + b + c;
    const std::array<Whole, 3> weighed = {sum + a, sum + b, sum + c};
    const Whole four = weighed[dice.below(3)];
    const Whole on_face = {four.x / 4, four.y / 4, four.z / 4};
    const auto above = [&] {
        const Whole off = any_whole(dice, 16);
        return on_face + (dot(normal, off) < 0 ? -1 : 1) * off;
    };
    const Whole second = above();
    return stored_in_any_order({a, b, c, on_face, second, above()}, dice);
}

SixPoints edge_crosses_edge_six(Dice& dice)
{
    Whole half, other, normal;
    do {
        half = any_whole(dice, 8);
        other = any_whole(dice, 8);
        normal = cross(half, other);
    } while (is_zero(normal));
    const Whole middle = any_whole(dice, 16);
    const auto on_side = [&](int side) {
        Whole off;
        do
            off = any_whole(dice, 16);
        while (dot(normal, off) == 0);
        return middle + ((dot(normal, off) > 0) == (side > 0) ? 1 : -1) * off;
    };
    const int before = dice.between(1, 3), behind = dice.between(1, 3);
    const Whole first = on_side(1);
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
            case 2:  // three in a line
                six[at + 2] = {2 * six[at + 1].x - six[at].x, 2 * six[at + 1].y - six[at].y,
                               2 * six[at + 1].z - six[at].z};
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
