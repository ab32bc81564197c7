// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "geometry/triangle.h"

namespace bvhbench {

/// SplitMix64 (Steele, Lea, Flood: "Fast Splittable Pseudorandom Number Generators"). Gives the same numbers on every machine,
/// unlike the distributions of the standard library.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits()
    {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t mixed = state_;
        mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9u;
        mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebu;
        return mixed ^ (mixed >> 31);
    }

    /// Returns a multiple of 2^-24 in [0, 1), exact in float.
    float unit() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }

    /// Returns a number in [-1, 1).
    float symmetric() { return 2.0f * unit() - 1.0f; }

    /// Returns a point in the unit ball, not at its centre, by rejection sampling.
    Point in_ball()
    {
        while (true) {
            const float x = symmetric(), y = symmetric(), z = symmetric();
            const float square = x * x + y * y + z * z;
            if (square < 1.0f && square > 1e-6f)
                return {x, y, z};
        }
    }

private:
    std::uint64_t state_;
};

}  // namespace bvhbench
