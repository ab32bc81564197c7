// SPDX-License-Identifier: MIT
#include "builders/implicit/host_levels.h"

#include <algorithm>
#include <cstdint>

namespace bvhbench {
namespace {

/// Four neighbouring floats of a box, wherever it starts: one instruction where floats would be six.
typedef float FourFloats __attribute__((vector_size(16), aligned(4), may_alias));

/// `merged`, of boxes without NaN, in two vectors that overlap: the lower four floats have the three minima, the
/// upper four the three maxima. Compilers make one instruction of either choice, and six of merged's.
inline Aabb merged_boxes(const Aabb& a, const Aabb& b)
{
    const auto fours = [](const float& first) {
        return *reinterpret_cast<const FourFloats*>(&first);
    };
    const FourFloats a_low = fours(a.min_x), a_high = fours(a.min_z);
    const FourFloats b_low = fours(b.min_x), b_high = fours(b.min_z);
    const FourFloats low = a_low < b_low ? a_low : b_low;
    const FourFloats high = a_high > b_high ? a_high : b_high;
    return {low[0], low[1], low[2], high[1], high[2], high[3]};
}

template <class Side>
inline BoxOf<Side> merged_boxes(const BoxOf<Side>& a, const BoxOf<Side>& b)
{
    BoxOf<Side> box;
    for (int k = 0; k < 3; ++k) {
        box.low[k] = std::min(a.low[k], b.low[k]);
        box.high[k] = std::max(a.high[k], b.high[k]);
    }
    return box;
}

}  // namespace

template <class Box>
void HostLevels<Box>::merge_leaves(uint level, uint begin, uint end) const
{
    Box* const to = nodes + layout.first_slot(leaves, level);
    const uint pairs = std::min(end, leaves / 2);
    uint p = begin;
    for (; p < pairs; ++p)
        to[p] = merged_boxes(leaf_boxes[ids[2 * p]], leaf_boxes[ids[2 * p + 1]]);
    if (p < end)
        to[p] = leaf_boxes[ids[2 * p]];
}

template <class Box>
void HostLevels<Box>::merge_children(uint level, uint begin, uint end) const
{
    Box* const to = nodes + layout.first_slot(leaves, level);
    const Box* const from = nodes + layout.first_slot(leaves, level + 1);
    const uint pairs = std::min(end, implicit_used_on(leaves, level + 1) / 2);
    uint p = begin;
    for (; p < pairs; ++p)
        to[p] = merged_boxes(from[2 * p], from[2 * p + 1]);
    if (p < end)
        to[p] = from[2 * p];
}

template <class Box>
void HostLevels<Box>::build_subtree(uint root_level, uint position) const
{
    const uint entry_level = implicit_leaf_level(leaves) - 1;
    for (uint above = entry_level - root_level + 1; above-- > 0;) {
        const uint level = root_level + above;
        const uint used = implicit_used_on(leaves, level);
        const uint begin = std::min(position << above, used);
        const uint end = std::min((position + 1) << above, used);
        if (level == entry_level && leaf_boxes != nullptr)
            merge_leaves(level, begin, end);
        else
            merge_children(level, begin, end);
    }
}

template <class Box>
void HostLevels<Box>::build_above(uint level) const
{
    while (level-- > 0)
        merge_children(level, 0, implicit_used_on(leaves, level));
}

template struct HostLevels<Aabb>;
template struct HostLevels<BoxOf<double>>;
template struct HostLevels<BoxOf<std::uint16_t>>;
template struct HostLevels<BoxOf<std::uint8_t>>;

}  // namespace bvhbench
