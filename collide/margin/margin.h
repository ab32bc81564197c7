// SPDX-License-Identifier: MIT
//
// Device part of the rule `margin` (skips.h): pairs that serve for several frames, as the lists of [Verlet1967].
//
//     renewed frame    room around each vertex  ->  tree over boxes with room  ->  a collider's list  ->  its pairs that overlap now
//     served frame     is each vertex in its room?                                                    ->  its pairs that overlap now
//
// Proof. A triangle's box with room contains the room of its three corners. While each vertex is in its own room, that box contains
// the triangle's box: two boxes that overlap now are of a pair on the list. Nothing is rounded: rooms are compared as stored.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "builders/input.h"
#include "builders/stages/bounds.h"
#include "collide/collider.h"

namespace bvhbench {

/// What a frame does under the rule.
enum class MarginFrame {
    plain,    ///< as without the rule
    renewed,  ///< the collider makes a new list
    served,   ///< pairs come from the list: nothing is built or queried
};

class MarginPairs {
public:
    explicit MarginPairs(Programs& programs, KernelForm form = KernelForm::of_device);

    /// Reserves memory for frames like `input`: same faces, any points. Never timed. Blocks.
    void reserve(const Input& input);

    /// Bytes of device memory reserved at present.
    std::size_t bytes() const;

    /// Begins a frame and decides what it does: it is served if it can be. A list that served none is followed by 1, 3, 7, then 15
    /// plain frames. Not timed: it copies the points, which a simulation keeps from frame to frame. Blocks.
    MarginFrame begin(const Input& input, Queue& queue);

    /// True if each vertex is still in its room. Enqueues the stage `margin`, and blocks.
    bool still_serves(const Input& input, Queue& queue);

    /// Gives each vertex room around its way in the next frames, in the stage `margin`. Returns the input for builders and colliders:
    /// swept, over the ends of the rooms; its host points are not those. Does not block.
    Input with_room(const Input& input, Queue& queue);

    /// Enqueues the stage `filter`: finds those of the pairs listed, `most` at most, whose boxes overlap now. Does not block.
    void filter(const DevicePairs& listed, std::size_t most, const Input& input, Queue& queue);

    /// True if the last filter had room for all pairs; otherwise takes more. Blocks.
    bool complete(const Queue& queue);

    /// Points of the frame before, and whether at least half of the vertices still have these.
    const Buffer<Point>& points_before() const { return before_; }
    bool mostly_rests() const { return mostly_rests_; }

    /// Pairs of the last filter. The last two functions block.
    DevicePairs found() const { return {pairs_, counters_}; }
    std::uint64_t count(const Queue& queue) const;
    std::vector<Pair> pairs(const Queue& queue) const;

private:
    bool can_renew(const Input& input, std::span<const Point> before);
    void take_pairs();
    void launch(cl::Kernel& kernel, std::size_t items, std::int64_t moved_bytes, Queue& queue);

    Programs& programs_;
    KernelForm form_;
    std::size_t chunks_;
    BoundsStage bounds_;
    cl::Kernel check_, give_, filter_;
    std::optional<Arena> arena_, pairs_arena_;
    Buffer<Point> before_, now_;  ///< points of the last frame and of this one
    Buffer<Point> low_, high_;    ///< ends of each vertex's room
    Buffer<uint> outside_;        ///< 1 if a vertex is not in its room
    Buffer<uint> counters_;
    Buffer<Pair> pairs_, blocks_;
    std::size_t pair_room_ = 0;
    std::vector<Point> host_points_;  ///< of this frame; empty before the first
    bool mostly_rests_ = false;
    float skin_ = 0;                  ///< room to all sides in any case, a length
    float frames_ = 0;                ///< that a vertex has room for, if it goes on as it did
    int served_ = -1;                 ///< frames that the list has served; -1: there is none
    int pause_ = 0, plain_left_ = 0;  ///< plain frames after the last list, and those to come
};

}  // namespace bvhbench
