// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/doubles.h"

namespace bvhbench {

/// A number of a file: as it is there, and the float nearest to it.
struct FileNumber {
    double wide = 0;
    float rounded = 0;
    bool floats_hold = true;  ///< whether the float says the same
};

/// Three of them.
struct FilePoint {
    WidePoint wide;
    Point rounded;
    bool floats_hold = true;

    FilePoint(FileNumber x, FileNumber y, FileNumber z)
        : wide{x.wide, y.wide, z.wide}
        , rounded{x.rounded, y.rounded, z.rounded}
        , floats_hold(x.floats_hold && y.floats_hold && z.floats_hold)
    {}
};

}  // namespace bvhbench
