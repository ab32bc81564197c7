// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/scene.h"

namespace bvhbench {

/// How an object goes from one frame to another.
enum class Motion {
    unchanged,  ///< every position is the same, bit for bit
    rigid,      ///< all positions are those of one turn and shift, but for rounding
    deforming,
};

/// What rounds a coordinate to float: it moves by no more than this part of itself.
constexpr double float_rounding = 0x1p-24;

/// For each object of `scene`, how the vertices its triangles name go from frame `from` to frame `to`.
///
/// An object is rigid when the best turn and shift leaves no vertex farther from its place than could be if both
/// frames were an exact rigid motion whose coordinates were then rounded once, by `rounding` of the largest
/// coordinate of the object in that frame (the bound: `fit_allowances`, scenes/rigid_fit.h). So whatever is rigid
/// is found to be, and what is deformed by more than some five roundings is not. Where a frame was stored with
/// fewer digits, give their rounding.
std::vector<Motion> object_motions(const Scene& scene, std::size_t from, std::size_t to,
                                   double rounding = float_rounding);

}  // namespace bvhbench
