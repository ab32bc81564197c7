// SPDX-License-Identifier: MIT
#include "cluster/reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bvhbench {
namespace {

constexpr float farthest = 0x1p60f;

/// Returns an upper end, moved outward.
float padded(float end, float reach)
{
    const float moved = end + reach, outside = moved + (std::abs(moved) * 0x1p-22f + 0x1p-120f);
    return reach == 0 ? end : std::max(end, std::clamp(outside, -farthest, farthest));
}

float padded_again(float end, float reach)
{
    if (reach == 0)
        return end;
    return end < farthest ? end + reach + ((std::abs(end) + reach) * 0x1p-20f + 0x1p-118f)
                          : std::numeric_limits<float>::infinity();
}

/// Returns the box with each end moved outward by `move`, a function of an upper end.
template <class Move>
Aabb moved(const Aabb& box, const Move& move)
{
    return {-move(-box.min_x), -move(-box.min_y), -move(-box.min_z),
            move(box.max_x),   move(box.max_y),   move(box.max_z)};
}

}  // namespace

Aabb padded(const Aabb& box, float reach)
{
    return moved(box, [reach](float end) { return padded(end, reach); });
}

Aabb padded_again(const Aabb& box, float reach)
{
    return moved(box, [reach](float end) { return padded_again(end, reach); });
}

}  // namespace bvhbench
