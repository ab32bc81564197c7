// SPDX-License-Identifier: MIT
//
// Pairs of triangles that are hard to tell apart, each class in its own way. Pair k is faces 2k and 2k + 1.
#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "geometry/mesh.h"

namespace bvhbench {

/// Random numbers that are the same everywhere: the standard's distributions are not.
class Dice {
public:
    explicit Dice(uint seed) : engine_(seed) {}
    uint below(uint count) { return static_cast<uint>(engine_() % count); }
    float unit() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
    uint word() { return static_cast<uint>(engine_()); }
    Point point() { return {unit(), unit(), unit()}; }
    Point lattice(uint cells)
    {
        return {static_cast<float>(below(cells)), static_cast<float>(below(cells)),
                static_cast<float>(below(cells))};
    }

private:
    std::mt19937 engine_;
};

/// Corners of a pair of triangles, none shared by index.
using SixPoints = std::array<Point, 6>;

inline SixPoints generic_six(Dice& dice)
{
    return {dice.point(), dice.point(), dice.point(), dice.point(), dice.point(), dice.point()};
}

inline SixPoints lattice_six(Dice& dice, uint cells)
{
    SixPoints six;
    for (Point& p : six)
        p = dice.lattice(cells);
    return six;
}

inline float some_steps(float x, int steps)
{
    for (; steps != 0; steps += steps < 0 ? 1 : -1)
        x = std::nextafter(x, steps < 0 ? -1e9f : 1e9f);
    return x;
}

/// A corner of the second within some steps of the first's face.
inline SixPoints near_touching_six(Dice& dice)
{
    SixPoints six = generic_six(dice);
    double u = dice.unit(), v = dice.unit();
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    const auto on_face = [&](float Point::*c) {
        const double x = six[0].*c + u * (six[1].*c - six[0].*c) + v * (six[2].*c - six[0].*c);
        return some_steps(static_cast<float>(x), static_cast<int>(dice.below(5)) - 2);
    };
    six[3] = {on_face(&Point::x), on_face(&Point::y), on_face(&Point::z)};
    return six;
}

/// All six in one plane, which is not parallel to an axis.
inline SixPoints coplanar_six(Dice& dice)
{
    SixPoints six = lattice_six(dice, 8);
    for (Point& p : six)
        p.z = p.x + 2 * p.y + 0.5f;
    return six;
}

inline SixPoints near_coplanar_six(Dice& dice)
{
    SixPoints six = coplanar_six(dice);
    Point& moved = six[dice.below(6)];
    moved.z = some_steps(moved.z, dice.below(2) == 0 ? 1 : -1);
    return six;
}

/// Two corners of each all but at one place, the second through the first or close by.
inline SixPoints needle_six(Dice& dice)
{
    SixPoints six = generic_six(dice);
    const auto beside = [&](Point p) {
        return Point{p.x + 1e-6f * dice.unit(), p.y + 1e-6f * dice.unit(),
                     p.z + 1e-6f * dice.unit()};
    };
    six[1] = beside(six[0]);
    six[4] = beside(six[3]);
    const Point middle = {0.5f * (six[0].x + six[2].x), 0.5f * (six[0].y + six[2].y),
                          0.5f * (six[0].z + six[2].z)};
    six[5] = beside({2 * middle.x - six[3].x, 2 * middle.y - six[3].y, 2 * middle.z - six[3].z});
    return six;
}

/// In one plane but for what is less than a double holds beside the rest.
inline SixPoints hairs_breadth_six(Dice& dice)
{
    SixPoints six = lattice_six(dice, 3);
    for (Point& p : six) {
        p.z = p.x + 2 * p.y;
        for (float Point::*c : {&Point::x, &Point::y, &Point::z})
            if (p.*c == 0.0f)
                p.*c = (static_cast<float>(dice.below(3)) - 1.0f) * 1e-30f;
    }
    return six;
}

/// A corner at the place of the other's, under an index of its own.
inline SixPoints same_place_six(Dice& dice)
{
    SixPoints six = generic_six(dice);
    six[3 + dice.below(3)] = six[dice.below(3)];
    return six;
}

inline SixPoints twice_six(Dice& dice)
{
    SixPoints six = generic_six(dice);
    for (std::size_t k = 0; k < 3; ++k)
        six[3 + k] = six[2 - k];
    if (dice.below(2) == 0)
        six[3].x = some_steps(six[3].x, 1);
    return six;
}

/// Segments and points among triangles, on few places.
inline SixPoints degenerate_six(Dice& dice)
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

inline SixPoints collinear_six(Dice& dice)
{
    SixPoints six;
    for (Point& p : six) {
        const auto t = static_cast<float>(dice.below(12));
        p = {t, 2 * t, 1 - t};
    }
    return six;
}

/// Coordinates of any size that a float can have, denormals among them.
inline SixPoints any_size_six(Dice& dice)
{
    SixPoints six = generic_six(dice);
    for (Point& p : six)
        for (float Point::*c : {&Point::x, &Point::y, &Point::z})
            do
                p.*c = as_float(dice.word());
            while (!std::isfinite(p.*c));
    return six;
}

inline SixPoints scaled(SixPoints six, float scale)
{
    for (Point& p : six)
        p = {p.x * scale, p.y * scale, p.z * scale};
    return six;
}

inline SixPoints moved(SixPoints six, float by)
{
    for (Point& p : six)
        p = {p.x + by, p.y + by, p.z - by};
    return six;
}

struct PairClass {
    std::string name;
    std::function<SixPoints(Dice&)> six;
};

inline std::vector<PairClass> pair_classes()
{
    std::vector<PairClass> classes = {
        {"generic", generic_six},
        {"near_touching", near_touching_six},
        {"coplanar_lattice", coplanar_six},
        {"near_coplanar", near_coplanar_six},
        {"lattice_8", [](Dice& dice) { return lattice_six(dice, 8); }},
        {"lattice_3", [](Dice& dice) { return lattice_six(dice, 3); }},
        {"needles", needle_six},
        {"hairs_breadth", hairs_breadth_six},
        {"same_place", same_place_six},
        {"twice", twice_six},
        {"degenerate", degenerate_six},
        {"collinear", collinear_six},
        {"any_size", any_size_six},
        {"translated_1e5", [](Dice& dice) { return moved(near_touching_six(dice), 1e5f); }},
        {"denormals", [](Dice& dice) { return scaled(lattice_six(dice, 9), 1.4e-45f); }},
        {"small_and_denormal", [](Dice& dice) { return scaled(near_touching_six(dice), 1e-37f); }},
        {"largest", [](Dice& dice) { return scaled(near_touching_six(dice), 3.4e38f); }},
        {"flat_and_small",
         [](Dice& dice) {
             SixPoints six = generic_six(dice);
             for (Point& p : six)
                 p.z *= 1e-12f;
             return six;
         }},
    };
    // Among them those whose products of three floats are where floats end, at either end.
    for (const auto& [name, scale] : {std::pair{"1e-30", 1e-30f},
                                      {"1e-16", 1e-16f},
                                      {"1e-15", 1e-15f},
                                      {"1e-14", 1e-14f},
                                      {"1e-13", 1e-13f},
                                      {"1e-4", 1e-4f},
                                      {"1e10", 1e10f},
                                      {"4e12", 4e12f},
                                      {"7e12", 7e12f},
                                      {"1e13", 1e13f},
                                      {"1e30", 1e30f}})
        classes.push_back({std::string("scaled_") + name, [scale = scale](Dice& dice) {
                               return scaled(near_touching_six(dice), scale);
                           }});
    return classes;
}

/// `count` pairs of a class that share no index.
inline Mesh apart_pairs(const PairClass& of, uint count)
{
    Dice dice(count);
    Mesh mesh;
    for (uint k = 0; k < count; ++k) {
        const SixPoints six = of.six(dice);
        mesh.points.insert(mesh.points.end(), six.begin(), six.end());
        mesh.faces.insert(mesh.faces.end(),
                          {{6 * k, 6 * k + 1, 6 * k + 2}, {6 * k + 3, 6 * k + 4, 6 * k + 5}});
    }
    return mesh;
}

/// The same, with one to three indices of each second face, at any corners, those of the first; now and then an
/// index twice in a face.
inline Mesh adjacent_pairs(const PairClass& of, uint count)
{
    Mesh mesh = apart_pairs(of, count);
    Dice dice(count + 1);
    for (uint k = 0; k < count; ++k) {
        const uint place = 6 * k;
        std::array<uint, 3> first = {place, place + 1, place + 2};
        std::array<uint, 3> second = {place + 3, place + 4, place + 5};
        const uint shared = dice.below(8) == 0 ? 3 : 1 + dice.below(2), turn = dice.below(3);
        for (uint s = 0; s < shared; ++s)
            second[(s + turn) % 3] = first[s];
        if (dice.below(2) == 0)
            std::swap(second[0], second[1]);
        if (dice.below(16) == 0)
            first[dice.below(3)] = first[dice.below(3)];
        if (dice.below(16) == 0)
            second[dice.below(3)] = second[dice.below(3)];
        std::swap(first[0], first[dice.below(3)]);
        mesh.faces[2 * k] = {first[0], first[1], first[2]};
        mesh.faces[2 * k + 1] = {second[0], second[1], second[2]};
    }
    return mesh;
}

}  // namespace bvhbench
