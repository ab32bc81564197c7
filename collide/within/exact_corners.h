// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "collide/narrow/exact_contact.h"
#include "collide/within/features.h"
#include "collide/within/integer.h"

namespace bvhbench {

struct Exact {
    Integer x, y, z;
};

inline Exact less(const Exact& a, const Exact& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Integer dot(const Exact& a, const Exact& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Exact cross_product(const Exact& a, const Exact& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The corners of two triangles as integers, in units of 2^unit. It divides `distance` too.
struct ExactCorners {
    int unit = std::numeric_limits<int>::max();
    Three<Exact> a, b;

    ExactCorners(const Corners& p, const Corners& q, double distance = 0)
    {
        take_in(distance);
        for (const Corners& corners : {p, q})
            for (const Point at : corners.at)
                for (const float value : {at.x, at.y, at.z})
                    take_in(value);
        if (unit == std::numeric_limits<int>::max())
            unit = 0;  // all are 0
        for (std::size_t k = 0; k < 3; ++k) {
            a[k] = exact(p.at[k]);
            b[k] = exact(q.at[k]);
        }
    }

private:
    /// Lowers the unit to the last digit of `value`.
    void take_in(double value)
    {
        int exponent = 0;
        double rest = std::frexp(value, &exponent);
        if (rest == 0)
            return;
        for (; rest != std::floor(rest); rest *= 2)
            --exponent;
        unit = std::min(unit, exponent);
    }

    Exact exact(Point at) const
    {
        return {Integer(at.x, unit), Integer(at.y, unit), Integer(at.z, unit)};
    }
};

}  // namespace bvhbench
