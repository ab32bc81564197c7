// SPDX-License-Identifier: MIT
#include "collide/within/exact_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "collide/within/integer.h"

namespace bvhbench {
namespace {

struct Exact {
    Integer x, y, z;
};

Exact operator-(const Exact& a, const Exact& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Integer dot(const Exact& a, const Exact& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Integer square(const Exact& a) { return dot(a, a); }
Exact cross(const Exact& a, const Exact& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

using Triangle = std::array<Exact, 3>;

bool is_between(const Integer& low, const Integer& value, const Integer& high)
{
    return low <= value && value <= high;
}

/// True if p is within the root of `most` of its foot on the edge from q to r, and there is one.
bool near_edge(const Exact& p, const Exact& q, const Exact& r, const Integer& most)
{
    const Exact side = r - q, way = p - q;
    const Integer length = square(side), along = dot(way, side);
    return length.sign() > 0 && is_between({}, along, length) &&
           square(way) * length - along * along <= most * length;
}

/// The same of the common perpendicular of the edges from p with side u and from q with side v.
bool near_across(const Exact& p, const Exact& u, const Exact& q, const Exact& v,
                 const Integer& most)
{
    const Exact normal = cross(u, v), way = q - p;
    const Integer area = square(normal), height = dot(way, normal);
    return area.sign() > 0 && is_between({}, dot(cross(way, v), normal), area) &&
           is_between({}, dot(cross(way, u), normal), area) && height * height <= most * area;
}

/// The same of the foot of p in a face.
bool near_face(const Exact& p, const Triangle& face, const Integer& most)
{
    const Exact normal = cross(face[1] - face[0], face[2] - face[0]);
    const Integer area = square(normal), height = dot(p - face[0], normal);
    bool is_inside = area.sign() > 0;
    for (std::size_t k = 0; k < 3 && is_inside; ++k)
        is_inside = dot(cross(face[(k + 1) % 3] - face[k], p - face[k]), normal).sign() >= 0;
    return is_inside && height * height <= most * area;
}

bool are_near(const Triangle& a, const Triangle& b, const Integer& most)
{
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const Exact &p = a[i], &q = b[j], &r = a[(i + 1) % 3], &s = b[(j + 1) % 3];
            if (square(p - q) <= most || near_edge(p, q, s, most) || near_edge(q, p, r, most) ||
                near_across(p, r - p, q, s - q, most))
                return true;
        }
    return std::ranges::any_of(a, [&](const Exact& p) { return near_face(p, b, most); }) ||
           std::ranges::any_of(b, [&](const Exact& p) { return near_face(p, a, most); });
}

/// Lowers `unit` to the exponent of the last digit of `value`.
void take_in(double value, int& unit)
{
    int exponent = 0;
    double rest = std::frexp(value, &exponent);
    if (rest == 0)
        return;
    for (; rest != std::floor(rest); rest *= 2)
        --exponent;
    unit = std::min(unit, exponent);
}

}  // namespace

bool parted_within(const Corners& a, const Corners& b, double distance)
{
    int unit = std::numeric_limits<int>::max();
    take_in(distance, unit);
    for (const Corners& corners : {a, b})
        for (const Point p : corners.at)
            for (const float value : {p.x, p.y, p.z})
                take_in(value, unit);
    const auto exact = [unit](const Corners& corners) {
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            const Point p = corners.at[k];
            triangle[k] = {Integer(p.x, unit), Integer(p.y, unit), Integer(p.z, unit)};
        }
        return triangle;
    };
    const Integer reach(distance, unit);
    return are_near(exact(a), exact(b), reach * reach);
}

}  // namespace bvhbench
