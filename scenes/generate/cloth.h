// SPDX-License-Identifier: MIT
//
// A small cloth simulation: particles of one mass, held apart and together by distances only, in small steps
// with one pass over all constraints each ([Macklin2019]: more steps do better than more passes).
//
//     *---*---*     stretch: neighbours along a row and a column
//     | X | X |     shear:   both diagonals of a cell, softer
//     *---*---*     bend:    neighbours but one, softer still
//
// One order of all operations, one thread, and only operations that IEEE 754 fixes: the same everywhere.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <utility>

#include "scenes/generate/obstacles.h"

namespace bvhbench {

/// Compliances are in metres a newton for particles of 1 kg; 0 is as stiff as one pass can make it.
struct ClothSettings {
    double step_s = 1e-3;
    double shear = 3e-6;
    double bend = 1e-5;
    double drag = 0.6;      ///< of speed, a second
    double friction = 0.5;  ///< with obstacles
    double apart =
        0.65;  ///< particles are kept apart by this part of the distance between neighbours
};

/// A sheet's particles: `columns` x `rows` cells, row by row; `closed`: the last column meets the first.
struct Sheet {
    uint first = 0, columns = 1, rows = 1;
    bool closed = false;

    uint stride() const { return closed ? columns : columns + 1; }
    uint particle(uint i, uint j) const { return first + j * stride() + i % stride(); }
};

/// Finds pairs of points that are near each other, by a hashed grid. Keeps its memory between calls.
class NearPairs {
public:
    /// All (i, j), i < j, of points nearer than `distance`, each once; in an order that depends on nothing but
    /// the points. Holds until the next call.
    const std::vector<std::pair<uint, uint>>& find(const std::vector<Vector>& points,
                                                   double distance);

private:
    using Cell = std::array<std::int64_t, 3>;
    std::size_t bucket(const Cell& cell) const;
    void sort(const std::vector<Vector>& points, double distance);

    std::vector<Cell> cells_;    ///< of the points
    std::vector<uint> begin_;    ///< of each bucket in `members_`, and the end of the last
    std::vector<uint> members_;  ///< points by bucket, ascending in each
    std::vector<std::pair<uint, uint>> pairs_;
};

class Cloth {
public:
    explicit Cloth(ClothSettings settings) : settings_(settings) {}

    /// A sheet whose cells have the lengths they have at `position(u, v)`, u and v from 0 to 1. Particles are
    /// then shaken a little: what is symmetric would never fold.
    Sheet add(uint columns, uint rows, bool closed,
              const std::function<Vector(double u, double v)>& position);

    /// From now on nothing moves the particle but `place`.
    void pin(uint particle) { movable_[particle] = 0; }
    void place(uint particle, Vector at) { positions_[particle] = at; }
    Vector position(uint particle) const { return positions_[particle]; }

    /// One step of `settings.step_s`. Obstacles and pinned particles stand where they were put.
    void step(const std::vector<const Obstacle*>& obstacles);

    /// The smooth surface through a sheet's particles (Catmull and Rom), outside of `obstacles`.
    Vector surface(const Sheet& sheet, double u, double v,
                   const std::vector<const Obstacle*>& obstacles) const;

private:
    struct Spring {
        uint a, b;
        double length, compliance;
    };
    void add_springs(const Sheet& sheet);
    bool are_neighbours(uint a, uint b) const;
    void stretch();
    void keep_apart();
    void meet(const std::vector<const Obstacle*>& obstacles);

    ClothSettings settings_;
    std::vector<Vector> positions_, before_, velocities_;
    std::vector<double> movable_;  ///< 1, or 0 where pinned
    std::vector<Spring> springs_;
    std::vector<Sheet> sheets_;
    std::vector<uint> sheet_of_;  ///< by particle
    double apart_ = 0;            ///< in metres
    NearPairs near_;
    std::vector<std::pair<uint, uint>> pairs_;  ///< that may have to be kept apart
    uint steps_ = 0;
};

}  // namespace bvhbench
