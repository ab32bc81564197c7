// SPDX-License-Identifier: MIT
//
// A small cloth simulation: particles of equal mass, coupled by distance constraints only, in small steps with one pass over
// all constraints per step ([Macklin2019]: more steps do better than more passes).
//
//     *---*---*     stretch: neighbours along a row and a column
//     | X | X |     shear:   both diagonals of a cell, softer
//     *---*---*     bend:    neighbours at distance two, softer still
//
// One thread, a fixed order of operations, and only operations that IEEE 754 defines: results are the same on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <utility>

#include "scenes/generate/obstacles.h"

namespace bvhbench {

/// Parameters of the simulation. Compliances are in metres per newton for particles of 1 kg; 0 is as stiff as one pass allows.
struct ClothSettings {
    double step_s = 1e-3;
    double shear = 3e-6;
    double bend = 1e-5;
    double drag = 0.6;      ///< relative loss of speed per second
    double friction = 0.5;  ///< friction coefficient with obstacles
    double apart =
        0.65;  ///< minimum distance of particles, as a fraction of the distance between neighbours
};

/// Particles of a sheet of `columns` x `rows` cells, row by row. `closed`: the last column is joined to the first.
struct Sheet {
    uint first = 0, columns = 1, rows = 1;
    bool closed = false;

    uint stride() const { return closed ? columns : columns + 1; }
    uint particle(uint i, uint j) const { return first + j * stride() + i % stride(); }
};

/// Finds pairs of nearby points with a hashed grid. Keeps its memory between calls.
class NearPairs {
public:
    /// Returns all pairs (i, j), i < j, of points nearer than `distance`, each once. Their order depends on the points only.
    /// The reference is valid until the next call.
    const std::vector<std::pair<uint, uint>>& find(const std::vector<Vector>& points,
                                                   double distance);

private:
    using Cell = std::array<std::int64_t, 3>;
    std::size_t bucket(const Cell& cell) const;
    void sort(const std::vector<Vector>& points, double distance);

    std::vector<Cell> cells_;    ///< cell of each point
    std::vector<uint> begin_;    ///< bucket starts in `members_`, and the last end
    std::vector<uint> members_;  ///< points by bucket, ascending in each
    std::vector<std::pair<uint, uint>> pairs_;
};

class Cloth {
public:
    explicit Cloth(ClothSettings settings) : settings_(settings) {}

    /// Adds a sheet whose cells have the rest lengths that they have at `position(u, v)`, u and v from 0 to 1. Perturbs the
    /// particles slightly, because a symmetric sheet would never fold.
    Sheet add(uint columns, uint rows, bool closed,
              const std::function<Vector(double u, double v)>& position);

    /// Pins a particle: from now on only `place` moves it.
    void pin(uint particle) { movable_[particle] = 0; }
    void place(uint particle, Vector at) { positions_[particle] = at; }
    Vector position(uint particle) const { return positions_[particle]; }

    /// Advances by `settings.step_s`. Obstacles and pinned particles do not move.
    void step(const std::vector<const Obstacle*>& obstacles);

    /// Returns a point of the smooth surface through a sheet's particles (Catmull-Rom), moved outside of `obstacles`.
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
    std::vector<double> movable_;  ///< 1, or 0 if pinned
    std::vector<Spring> springs_;
    std::vector<Sheet> sheets_;
    std::vector<uint> sheet_of_;  ///< sheet of each particle
    double apart_ = 0;            ///< in metres
    NearPairs near_;
    std::vector<std::pair<uint, uint>> pairs_;  ///< pairs that may have to be kept apart
    uint steps_ = 0;
};

}  // namespace bvhbench
