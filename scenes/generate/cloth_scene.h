// SPDX-License-Identifier: MIT
//
// What scenes of cloth have in common.
#pragma once

#include <algorithm>

#include "scenes/generate/cloth.h"
#include "scenes/generate/film.h"
#include "scenes/generate/generators.h"
#include "scenes/generate/sheet_mesh.h"

namespace bvhbench {

/// Cells along a side of a square sheet of so many triangles, to be simulated: not more than are drawn, but
/// enough to fall like cloth.
inline uint sheet_cells(uint triangles, uint most)
{
    const auto drawn = static_cast<uint>(std::sqrt(0.5 * triangles));
    return std::clamp<uint>(drawn, 8, most);
}

/// The surface of `lathe`, as triangles: u goes round, v down its profile.
inline Vector on_lathe(const Lathe& lathe, Point at)
{
    const double low = lathe.profile.front().height, high = lathe.profile.back().height;
    const double height = high - at.y * (high - low);
    const auto surface = lathe.radius_at(std::clamp(height, low, high));
    const Turn turn = turn_of(at.x);
    const double radius = surface ? surface->first : 0;
    return lathe.placement.place({radius * turn.cosine, height, radius * turn.sine});
}

}  // namespace bvhbench
