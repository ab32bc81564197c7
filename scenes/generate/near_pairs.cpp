// SPDX-License-Identifier: MIT
#include "scenes/generate/near_pairs.h"

#include <bit>

namespace bvhbench {

std::size_t NearPairs::bucket(const Cell& cell) const
{
    const std::uint64_t mixed = static_cast<std::uint64_t>(cell[0]) * 0x9e3779b97f4a7c15u ^
                                static_cast<std::uint64_t>(cell[1]) * 0xbf58476d1ce4e5b9u ^
                                static_cast<std::uint64_t>(cell[2]) * 0x94d049bb133111ebu;
    return (mixed >> 20) & (begin_.size() - 2);  // a power of two of buckets
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
    for (std::size_t k = points.size(); k-- > 0;)  // from the back, which turns ends into begins
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

}  // namespace bvhbench
