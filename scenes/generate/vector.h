// SPDX-License-Identifier: MIT
//
// Arithmetic of points (floats) and vectors (doubles), for simulations whose results are rounded to float once. Only operations
// that IEEE 754 defines are used: with sin, a simulation would differ between C libraries by far more than a last bit.
#pragma once

#include <cmath>
#include <concepts>

#include "geometry/vectors.h"

namespace bvhbench {

template <class V>
concept Triple = std::same_as<V, Point> || std::same_as<V, Vector>;

template <Triple V>
constexpr V operator+(V a, V b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <Triple V>
constexpr V operator-(V a, V b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <Triple V>
constexpr V operator*(decltype(V::x) s, V a)
{
    return {s * a.x, s * a.y, s * a.z};
}
template <Triple V>
constexpr V cross(V a, V b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr float dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <Triple V>
auto length(V a)
{
    return std::sqrt(dot(a, a));
}

constexpr Vector vector_of(Point point) { return {point.x, point.y, point.z}; }
constexpr Point rounded(Vector a)
{
    return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

/// A point on the unit circle: cosine and sine of an angle.
struct Turn {
    double cosine = 1, sine = 0;
};

/// Returns the point after `turns` full turns, accurate to about 1e-15 and the same on every machine.
inline Turn turn_of(double turns)
{
    const double quarters = std::floor(4 * turns + 0.5);
    const double x =
        1.5707963267948966 * (4 * turns - quarters);  // at most an eighth of a turn from 0
    const double s = x * x;
    double sine = 0, cosine = 0;  // Taylor to x^17 and x^18
    for (int k = 17; k >= 1; k -= 2) {
        sine = 1 - s / ((k + 1) * (k + 2)) * sine;
        cosine = 1 - s / (k * (k + 1)) * cosine;
    }
    sine *= x;
    switch (static_cast<int>(quarters - 4 * std::floor(quarters / 4))) {
        case 0:
            return {cosine, sine};
        case 1:
            return {-sine, cosine};
        case 2:
            return {-cosine, -sine};
        default:
            return {sine, -cosine};
    }
}

/// Returns `a` rotated about the y axis.
inline Vector turned(Vector a, Turn by)
{
    return {by.cosine * a.x + by.sine * a.z, a.y, by.cosine * a.z - by.sine * a.x};
}

}  // namespace bvhbench
