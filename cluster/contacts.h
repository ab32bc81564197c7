// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cluster/halo_triangle.h"
#include "cluster/pair_test.h"
#include "cluster/share.h"
#include "collide/collider.h"

namespace bvhbench {

/// Corners of a halo triangle, as they are sent where a narrow phase follows: 36 bytes.
struct HaloCorners {
    Point at[3];
};
static_assert(sizeof(HaloCorners) == 36);

/// The narrow phase of a rank: decides which of its pairs are kept, those with the halo included. It works on a mesh of its own, of
/// the rank's triangles followed by the halo's, which are numbered as in the pairs.
class RankContacts {
public:
    RankContacts(Programs& programs, const PairTest& test);

    /// Takes the rank's triangles and reserves memory. Never timed. Throws Unavailable.
    void take(const Share& share, Queue& queue);

    /// Pads the input of the rank's triangles, as PairDecider::padded.
    std::optional<Input> padded(const Input& input, Queue& queue)
    {
        return own_.padded(input, queue);
    }

    /// Takes the halo of the next frame. Blocks.
    void bring(const Share& share, std::span<const HaloTriangle> halo,
               std::span<const HaloCorners> corners, Queue& queue);

    /// Decides the pairs of the rank's triangles, and those with the halo; null if there are none of a kind. Blocks.
    void find(const DevicePairs* own, const DevicePairs* with_halo, Queue& queue);

    /// Returns what the last call found, numbered as the pairs. Blocks.
    std::vector<Pair> contacts(const Queue& queue) const;
    std::uint64_t count(const Queue& queue) const;

private:
    void upload_all(std::size_t halo_room, Queue& queue);

    Programs& programs_;
    PairDecider own_, halo_;
    bool has_own_ = false, has_halo_ = false;  ///< in the last call of `find`
    std::size_t own_points_ = 0, own_faces_ = 0;
    std::vector<Point> points_;
    std::vector<Face> faces_;
    Input input_;
};

}  // namespace bvhbench
