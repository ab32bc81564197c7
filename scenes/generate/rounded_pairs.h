// SPDX-License-Identifier: MIT
//
// Classes of pairs whose coordinates are rounded as they come: which of them meet, nobody knows beforehand.
#pragma once

#include "scenes/generate/pair_classes.h"

namespace bvhbench {

SixPoints generic_six(Dice& dice);
SixPoints near_touching_six(Dice& dice);
SixPoints near_coplanar_six(Dice& dice);
SixPoints needle_six(Dice& dice);
SixPoints sliver_six(Dice& dice);
SixPoints hairs_breadth_six(Dice& dice);
SixPoints twice_six(Dice& dice);
SixPoints any_size_six(Dice& dice);
SixPoints huge_and_small_six(Dice& dice);
SixPoints flat_and_small_six(Dice& dice);

SixPoints scaled(SixPoints six, float scale);
SixPoints moved(SixPoints six, float by);

/// `x`, so many floats further, towards minus infinity if negative.
float some_steps(float x, int steps);

}  // namespace bvhbench
