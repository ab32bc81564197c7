// SPDX-License-Identifier: MIT
//
// Vertices whose coordinates floats cannot hold, and how they become floats.
//
// Rounded as they are, vertices far from the origin fall onto the coarse grid that floats are there, and boxes that were
// apart touch (docs/accuracy.md, Input). With the middle of their box taken off before, in doubles, they keep nearly all
// that floats have. Either way the order of coordinates stays, so boxes that overlap still do.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh.h"

namespace bvhbench {

struct WidePoint {
    double x = 0, y = 0, z = 0;
};

/// What is done to doubles before they are rounded.
enum class Doubles {
    recentred,  ///< the middle of the box of all frames is taken off, and the rest scaled if floats do not reach so far
    as_is,      ///< nothing
};

/// "recentred", "as-is".
std::string_view doubles_name(Doubles how);
/// Throws BadUsage with the known names when there is none.
Doubles doubles_called(std::string_view name);

/// How doubles became floats: the float nearest to 2^scale_log2 (x - offset).
struct Rounding {
    std::optional<Doubles> how;  ///< none: floats held everything, and nothing was done
    WidePoint offset = {};       ///< in the file's unit
    int scale_log2 = 0;
    std::uint64_t rounded_count =
        0;                     ///< coordinates, of all frames, that are not exactly what they were
    double largest_error = 0;  ///< by how much, at most, in the file's unit
};

/// In a sentence, for people.
std::string rounding_text(const Rounding& rounding);

/// Make floats of `wide`, the same vertices in as many frames as there are in `frames`, which hold them rounded as they
/// are. One offset and one scale serve all frames: what stands still does so afterwards. Of coordinates that are not
/// finite, which no scene may have, infinity or NaN is left.
Rounding round_frames(std::span<const std::vector<WidePoint>> wide, Doubles how,
                      std::vector<std::vector<Point>>& frames);

}  // namespace bvhbench
