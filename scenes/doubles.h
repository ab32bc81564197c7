// SPDX-License-Identifier: MIT
//
// Conversion to floats of vertex coordinates that floats cannot hold exactly, or their keeping in doubles.
//
// Rounded directly, vertices far from the origin fall onto the coarse grid that floats have there, and disjoint boxes may touch
// (docs/accuracy.md, Input). If the middle of their box is subtracted first, in doubles, they keep nearly the full precision of
// floats. Both ways preserve the order of coordinates, so boxes that overlap still overlap.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh.h"
#include "geometry/moving_query.h"

namespace bvhbench {

/// Transformation of doubles before they are rounded.
enum class Doubles {
    recentred,  ///< subtract the middle of the box of all frames, and scale if the result is out of the range of floats
    as_is,      ///< none
    kept,  ///< subtract an offset where that is exact, and keep the doubles for steps between frames
};

/// Returns "recentred", "as-is" or "kept".
std::string_view doubles_name(Doubles how);
/// Inverse of doubles_name. Throws BadUsage, listing the known names, for any other name.
Doubles doubles_called(std::string_view name);

/// Result of a conversion of doubles x to the floats nearest to 2^scale_log2 (x - offset).
struct Rounding {
    std::optional<Doubles> how;  ///< none: floats held all coordinates, nothing changed
    WidePoint offset = {};       ///< in the unit of the file
    int scale_log2 = 0;
    std::uint64_t rounded_count =
        0;  ///< number of coordinates in all frames that were changed by rounding
    double largest_error = 0;  ///< largest change of a coordinate, in the unit of the file
};

/// Describes a rounding in one sentence.
std::string rounding_text(const Rounding& rounding);

/// Converts `wide` to floats. On entry, `frames` holds the same vertices and frames, rounded as they are; on return, the
/// converted ones. All frames share one offset and one scale, so vertices at rest remain at rest. Coordinates that are not
/// finite, which no scene may have, become infinity or NaN. `wide` is not changed: doubles that are kept are x - offset.
Rounding round_frames(std::span<const std::vector<WidePoint>> wide, Doubles how,
                      std::vector<std::vector<Point>>& frames);

}  // namespace bvhbench
