// SPDX-License-Identifier: MIT
//
// Classes of pairs that touch, overlap or miss each other exactly by construction: from small whole numbers, which floats hold
// exactly, or from copied corners.
#pragma once

#include "scenes/generate/pair_classes.h"

namespace bvhbench {

/// Random corners in the unit cube.
SixPoints generic_six(Dice& dice);
/// Corners with whole coordinates from 0 to `cells` - 1.
SixPoints lattice_six(Dice& dice, uint cells);
/// All six corners in the plane z = x + 2 y + 1/2.
SixPoints coplanar_six(Dice& dice);
SixPoints coplanar_overlapping_six(Dice& dice);
SixPoints coplanar_touching_six(Dice& dice);
SixPoints coplanar_disjoint_six(Dice& dice);
SixPoints coplanar_nested_six(Dice& dice);
/// The second triangle's corners are one float step above the plane.
SixPoints parallel_planes_six(Dice& dice);
SixPoints same_place_six(Dice& dice);
SixPoints shared_edge_six(Dice& dice);
SixPoints identical_six(Dice& dice);
SixPoints vertex_on_face_six(Dice& dice);
SixPoints edge_crosses_edge_six(Dice& dice);
SixPoints degenerate_six(Dice& dice);
SixPoints point_six(Dice& dice);
SixPoints collinear_six(Dice& dice);

}  // namespace bvhbench
