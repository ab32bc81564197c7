// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>

namespace bvhbench {

/// How a frame's tree comes from that of the frame before: all of it anew, new boxes for what stands, or not at all.
/// From what does most to what does nothing, so that of several the least brings all of them along.
enum class TreeUpdate { rebuild, refit, keep };

/// What brings along trees that want these if all must be treated alike.
inline TreeUpdate update_of_all(std::span<const TreeUpdate> wanted, bool can_refit)
{
    const TreeUpdate most = *std::min_element(wanted.begin(), wanted.end());
    return most == TreeUpdate::refit && !can_refit ? TreeUpdate::rebuild : most;
}

}  // namespace bvhbench
