// SPDX-License-Identifier: MIT
#include "scenes/generate/cloth.h"

#include <algorithm>
#include <array>
#include <bit>

#include "scenes/generate/random.h"

namespace bvhbench {
namespace {

constexpr double gravity = 9.81;
constexpr double fastest = 8;       ///< metres per second: keeps errors from growing without bound
constexpr uint pairs_hold_for = 3;  ///< number of steps for which a list of nearby pairs is reused

/// Weights of four neighbouring points of a curve that passes through the middle two.
std::array<double, 4> weights(double t)
{
    const double s = t * t, c = s * t;
    return {0.5 * (2 * s - c - t), 0.5 * (3 * c - 5 * s + 2), 0.5 * (4 * s - 3 * c + t),
            0.5 * (c - s)};
}

}  // namespace

std::size_t NearPairs::bucket(const Cell& cell) const
{
    const std::uint64_t mixed = static_cast<std::uint64_t>(cell[0]) * 0x9e3779b97f4a7c15u ^
                                static_cast<std::uint64_t>(cell[1]) * 0xbf58476d1ce4e5b9u ^
                                static_cast<std::uint64_t>(cell[2]) * 0x94d049bb133111ebu;
    return (mixed >> 20) & (begin_.size() - 2);  // the number of buckets is a power of two
}

void NearPairs::sort(const std::vector<Vector>& points, double distance)
{
    const auto along = [distance](double x) {
        return static_cast<std::int64_t>(std::floor(x / distance));
    };
    cells_.clear();
    for (const Vector& point : points)
        cells_.push_back({along(point.x), along(point.y), along(point.z)});
    begin_.assign(std::bit_ceil(2 * points.size() + 2) + 1, 0);
    for (const Cell& cell : cells_)
        ++begin_[bucket(cell)];
    for (std::size_t k = 1; k < begin_.size(); ++k)
        begin_[k] += begin_[k - 1];
    members_.resize(points.size());
    for (std::size_t k = points.size(); k-- > 0;)  // backwards: turns bucket ends into starts
        members_[--begin_[bucket(cells_[k])]] = static_cast<uint>(k);
}

const std::vector<std::pair<uint, uint>>& NearPairs::find(const std::vector<Vector>& points,
                                                          double distance)
{
    sort(points, distance);
    pairs_.clear();
    for (uint i = 0; i < points.size(); ++i)
        for (int k = 0; k < 27; ++k) {
            const Cell cell = {cells_[i][0] + k % 3 - 1, cells_[i][1] + k / 3 % 3 - 1,
                               cells_[i][2] + k / 9 - 1};
            const std::size_t home = bucket(cell);
            for (uint m = begin_[home]; m < begin_[home + 1]; ++m) {
                const uint j = members_[m];
                const Vector between = points[j] - points[i];
                if (j > i && cells_[j] == cell && dot(between, between) < distance * distance)
                    pairs_.emplace_back(i, j);
            }
        }
    return pairs_;
}

// Adds the springs of every other cell first, then the others: no direction is favoured, and no spring depends on the last one.
void Cloth::add_springs(const Sheet& sheet)
{
    const uint wide = sheet.columns, high = sheet.rows;
    const auto each = [&](uint across, uint down, auto&& add) {
        const uint columns = sheet.closed ? wide : wide + 1 - across;
        for (uint parity = 0; parity < 2; ++parity)
            for (uint j = 0; j + down <= high; ++j)
                for (uint i = parity; i < columns; i += 2)
                    add(i, j);
    };
    const auto join = [&](uint i, uint j, uint k, uint l, double compliance) {
        const uint a = sheet.particle(i, j), b = sheet.particle(k, l);
        springs_.push_back({a, b, length(positions_[b] - positions_[a]), compliance});
    };
    each(1, 0, [&](uint i, uint j) { join(i, j, i + 1, j, 0); });
    each(0, 1, [&](uint i, uint j) { join(i, j, i, j + 1, 0); });
    each(1, 1, [&](uint i, uint j) { join(i, j, i + 1, j + 1, settings_.shear); });
    each(1, 1, [&](uint i, uint j) { join(i + 1, j, i, j + 1, settings_.shear); });
    if (!sheet.closed || wide > 4)  // otherwise two steps around the ring meet from both sides
        each(2, 0, [&](uint i, uint j) { join(i, j, i + 2, j, settings_.bend); });
    each(0, 2, [&](uint i, uint j) { join(i, j, i, j + 2, settings_.bend); });
}

Sheet Cloth::add(uint columns, uint rows, bool closed,
                 const std::function<Vector(double u, double v)>& position)
{
    const Sheet sheet = {static_cast<uint>(positions_.size()), columns, rows, closed};
    for (uint j = 0; j <= rows; ++j)
        for (uint i = 0; i < sheet.stride(); ++i)
            positions_.push_back(
                position(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
    add_springs(sheet);
    sheet_of_.resize(positions_.size(), static_cast<uint>(sheets_.size()));
    sheets_.push_back(sheet);
    double sum = 0, count = 0;
    for (const Spring& spring : springs_)
        if (spring.compliance == 0) {
            sum += spring.length;
            ++count;
        }
    apart_ = settings_.apart * sum / count;
    Random random(sheet.first);
    for (std::size_t k = sheet.first; k < positions_.size(); ++k)
        positions_[k] = positions_[k] + (0.02 * apart_) * vector_of(random.in_ball());
    velocities_.resize(positions_.size());
    movable_.resize(positions_.size(), 1);
    return sheet;
}

void Cloth::stretch()
{
    const double per_square = 1 / (settings_.step_s * settings_.step_s);
    for (const Spring& spring : springs_) {
        const Vector between = positions_[spring.b] - positions_[spring.a];
        const double now = length(between);
        const double a = movable_[spring.a], b = movable_[spring.b];
        const double resists = a + b + spring.compliance * per_square;
        if (!(now > 0) || !(resists > 0))
            continue;
        const Vector by = ((now - spring.length) / (now * resists)) * between;
        positions_[spring.a] = positions_[spring.a] + a * by;
        positions_[spring.b] = positions_[spring.b] - b * by;
    }
}

/// True if two particles of one sheet are in adjacent cells, whose distances the springs control.
bool Cloth::are_neighbours(uint a, uint b) const
{
    if (sheet_of_[a] != sheet_of_[b])
        return false;
    const Sheet& sheet = sheets_[sheet_of_[a]];
    const uint stride = sheet.stride();
    const uint i = (a - sheet.first) % stride, k = (b - sheet.first) % stride;
    const uint j = (a - sheet.first) / stride, l = (b - sheet.first) / stride;
    const uint across = std::max(i, k) - std::min(i, k), down = std::max(j, l) - std::min(j, l);
    return down <= 1 && (across <= 1 || (sheet.closed && across + 1 == stride));
}

void Cloth::keep_apart()
{
    if (steps_ % pairs_hold_for == 0) {
        pairs_ = near_.find(positions_, 1.25 * apart_);  // margin for movement
        std::erase_if(pairs_,
                      [&](const auto& pair) { return are_neighbours(pair.first, pair.second); });
    }
    for (const auto& [i, j] : pairs_) {
        const Vector between = positions_[j] - positions_[i];
        const double square = dot(between, between);
        const double both = movable_[i] + movable_[j];
        if (square >= apart_ * apart_ || !(square > 0) || both == 0)
            continue;
        const double now = std::sqrt(square);
        const Vector by = ((apart_ - now) / (now * both)) * between;
        positions_[i] = positions_[i] - movable_[i] * by;
        positions_[j] = positions_[j] + movable_[j] * by;
    }
}

void Cloth::meet(const std::vector<const Obstacle*>& obstacles)
{
    for (std::size_t k = 0; k < positions_.size(); ++k) {
        if (movable_[k] == 0)
            continue;
        for (const Obstacle* const obstacle : obstacles) {
            const auto contact = obstacle->contact(positions_[k]);
            if (!contact)
                continue;
            positions_[k] = positions_[k] + contact->depth * contact->normal;
            const Vector slip = positions_[k] - before_[k] - settings_.step_s * contact->velocity;
            const Vector along = slip - dot(slip, contact->normal) * contact->normal;
            const double size = length(along), most = settings_.friction * contact->depth;
            positions_[k] = positions_[k] - (size > most ? most / size : 1.0) * along;
        }
    }
}

void Cloth::step(const std::vector<const Obstacle*>& obstacles)
{
    const double dt = settings_.step_s;
    before_ = positions_;
    for (std::size_t k = 0; k < positions_.size(); ++k) {
        Vector& v = velocities_[k];
        v = (1 - settings_.drag * dt) * (v + Vector{0, -gravity * dt, 0});
        positions_[k] = positions_[k] + (movable_[k] * dt) * v;
    }
    stretch();
    keep_apart();
    meet(obstacles);
    for (std::size_t k = 0; k < positions_.size(); ++k) {
        const Vector moved = positions_[k] - before_[k];
        const double size = length(moved), most = fastest * dt;
        if (size > most)
            positions_[k] = before_[k] + (most / size) * moved;
        velocities_[k] = (movable_[k] / dt) * (positions_[k] - before_[k]);
    }
    ++steps_;
}

Vector Cloth::surface(const Sheet& sheet, double u, double v,
                      const std::vector<const Obstacle*>& obstacles) const
{
    const double x = u * sheet.columns, y = v * sheet.rows;
    const uint i = std::min(static_cast<uint>(x), sheet.columns - 1);
    const uint j = std::min(static_cast<uint>(y), sheet.rows - 1);
    const auto across = weights(x - i), down = weights(y - j);
    // Continues the surface linearly beyond an edge: the second point is mirrored at the first.
    const auto in_row = [&](uint row, uint k) {
        const auto at = [&](uint column) { return positions_[sheet.particle(column, row)]; };
        if (sheet.closed)
            return at((i + k + sheet.columns - 1) % sheet.columns);
        if (i + k == 0)
            return 2 * at(0) - at(1);
        if (i + k > sheet.columns + 1)
            return 2 * at(sheet.columns) - at(sheet.columns - 1);
        return at(i + k - 1);
    };
    const auto row = [&](uint index) {
        Vector sum = {};
        for (uint k = 0; k < 4; ++k)
            sum = sum + across[k] * in_row(index, k);
        return sum;
    };
    Vector sum = {};
    for (uint k = 0; k < 4; ++k)
        if (j + k == 0)
            sum = sum + down[k] * (2 * row(0) - row(1));
        else if (j + k > sheet.rows + 1)
            sum = sum + down[k] * (2 * row(sheet.rows) - row(sheet.rows - 1));
        else
            sum = sum + down[k] * row(j + k - 1);
    for (const Obstacle* const obstacle : obstacles)
        if (const auto contact = obstacle->contact(sum))
            sum = sum + contact->depth * contact->normal;
    return sum;
}

}  // namespace bvhbench
