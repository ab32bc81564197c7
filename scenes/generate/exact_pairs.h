// SPDX-License-Identifier: MIT
//
// Classes of pairs that touch, overlap or miss each other exactly, by the way they are made: of small whole numbers,
// which floats hold, or of corners copied.
#pragma once

#include "scenes/generate/pair_classes.h"

namespace bvhbench {

/// Any corners in the unit cube.
SixPoints generic_six(Dice& dice);
/// Whole numbers from 0 to before `cells`.
SixPoints lattice_six(Dice& dice, uint cells);
/// All six in the plane z = x + 2 y + 1/2.
SixPoints coplanar_six(Dice& dice);
SixPoints coplanar_overlapping_six(Dice& dice);
SixPoints coplanar_touching_six(Dice& dice);
SixPoints coplanar_disjoint_six(Dice& dice);
SixPoints coplanar_nested_six(Dice& dice);
/// The second's corners one float step above it.
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
