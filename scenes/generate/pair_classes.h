// SPDX-License-Identifier: MIT
//
// Classes of triangle pairs that are difficult test cases for a narrow phase.
#pragma once

#include <array>
#include <functional>
#include <random>
#include <span>
#include <string>

#include "geometry/mesh.h"

namespace bvhbench {

/// Random numbers that are the same on every machine, unlike the distributions of the standard library.
class Dice {
public:
    explicit Dice(uint seed) : engine_(seed) {}
    uint below(uint count) { return static_cast<uint>(engine_() % count); }
    int between(int low, int high)
    {
        return low + static_cast<int>(below(static_cast<uint>(high - low + 1)));
    }
    float unit() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
    uint word() { return static_cast<uint>(engine_()); }
    Point point()
    {
        const float x = unit(), y = unit(), z = unit();
        return {x, y, z};
    }
    Point lattice(uint cells)
    {
        const uint x = below(cells), y = below(cells), z = below(cells);
        return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
    }

private:
    std::mt19937 engine_;
};

/// Corners of a pair of triangles without shared indices: three of the first, then three of the second.
using SixPoints = std::array<Point, 6>;

/// Which pairs of a class meet by construction, exactly for the coordinates as stored: unknown (some), all, or none.
enum class Meeting { some, all, none };

struct PairClass {
    std::string name;
    std::string summary;  ///< one line
    std::function<SixPoints(Dice&)> six;
    Meeting meeting = Meeting::some;
};

/// Returns all classes, in the order of tables.
std::span<const PairClass> pair_classes();

/// Returns the class called `name`. Throws BadUsage, listing the known names, if there is none.
const PairClass& find_pair_class(std::string_view name);

/// Returns `count` pairs of a class without shared indices: pair k is faces 2k and 2k + 1. The result depends on `seed` only.
Mesh apart_pairs(const PairClass& of, uint count, uint seed);

}  // namespace bvhbench
