// SPDX-License-Identifier: MIT
//
// Pairs of triangles that are hard to tell apart, each class in its own way: what a narrow phase is held to.
#pragma once

#include <array>
#include <functional>
#include <random>
#include <span>
#include <string>

#include "geometry/mesh.h"

namespace bvhbench {

/// Random numbers that are the same everywhere: the standard's distributions are not.
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

/// Corners of a pair of triangles, none shared by index: three of the first, three of the second.
using SixPoints = std::array<Point, 6>;

/// What the way in which a class is made promises, exactly, of the coordinates as stored.
enum class Meeting { some, all, none };

struct PairClass {
    std::string name;
    std::string summary;  ///< one line
    std::function<SixPoints(Dice&)> six;
    Meeting meeting = Meeting::some;
};

/// Every class, in the order tables list them.
std::span<const PairClass> pair_classes();

/// By name. Throws BadUsage with the known names when there is none.
const PairClass& find_pair_class(std::string_view name);

/// `count` pairs of a class that share no index: pair k is faces 2k and 2k + 1. The same for a seed on every machine.
Mesh apart_pairs(const PairClass& of, uint count, uint seed);

}  // namespace bvhbench
