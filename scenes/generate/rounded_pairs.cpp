// SPDX-License-Identifier: MIT
#include "scenes/generate/rounded_pairs.h"

#include <cmath>
#include <limits>

#include "scenes/generate/exact_pairs.h"

namespace bvhbench {
namespace {

constexpr float Point::*axes[] = {&Point::x, &Point::y, &Point::z};

Point beside(Point p, Dice& dice)
{
    const Point off = dice.point();
    return {p.x + 1e-6f * off.x, p.y + 1e-6f * off.y, p.z + 1e-6f * off.z};
}

/// Where p is if seen from the other side of `centre`.
Point through(Point centre, Point p)
{
    return {2 * centre.x - p.x, 2 * centre.y - p.y, 2 * centre.z - p.z};
}

Point between(Point a, Point b, float t)
{
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
}

}  // namespace

float some_steps(float x, int steps)
{
    constexpr float end = std::numeric_limits<float>::infinity();
    for (; steps != 0; steps += steps < 0 ? 1 : -1)
        x = std::nextafter(x, steps < 0 ? -end : end);
    return x;
}

SixPoints generic_six(Dice& dice)
{
    SixPoints six;
    for (Point& p : six)
        p = dice.point();
    return six;
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
    for (std::size_t k = 4; k < 6; ++k) {
        const Point off = dice.point();
        six[k] = {six[3].x + 1e-6f * (off.x - 0.5f), six[3].y + 1e-6f * (off.y - 0.5f),
                  six[3].z + 1e-6f * (off.z - 0.5f)};
    }
    return six;
}

SixPoints flat_and_small_six(Dice& dice)
{
    SixPoints six = generic_six(dice);
    for (Point& p : six)
        p.z *= 1e-12f;
    return six;
}

SixPoints scaled(SixPoints six, float scale)
{
    for (Point& p : six)
        p = {p.x * scale, p.y * scale, p.z * scale};
    return six;
}

SixPoints moved(SixPoints six, float by)
{
    for (Point& p : six)
        p = {p.x + by, p.y + by, p.z - by};
    return six;
}

}  // namespace bvhbench
