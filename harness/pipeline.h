// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "collide/narrow.h"
#include "harness/order_trials.h"
#include "harness/record.h"
#include "harness/session.h"
#include "scenes/motion.h"

namespace bvhbench {

/// From a frame's vertices to its pairs, and on to its contacts: a builder, if the collider wants a tree, the collider,
/// and a narrow phase, if one is chosen and the collider does not do its work.
class Pipeline {
public:
    /// Compile and take memory for frames like `input`. Throws what builders and colliders throw.
    Pipeline(Session& session, const BuilderChoice& builder, const ColliderChoice& collider,
             const Input& input);

    /// Frames from here on are of other points than those settled last, to which objects have moved so; of the first
    /// frame, and where nothing is known of how they moved, no motions. Trees are brought along as the collider asks
    /// if it goes on from frame to frame, else as the rules `unchanged`, `rigid` and `sorted` allow (skips.h).
    void begin_frame(std::span<const Motion> motions);

    /// One whole frame, again and again until nothing lacked room. Waits.
    void settle(const Input& input);

    /// One whole frame, in its stages. Waits. Throws Unavailable if it lacked room, which one that was settled over the
    /// same points does not.
    std::vector<StageTime> once(const Input& input);

    /// Of the last frame. All wait.
    bool has_pairs() const { return !collider_->finds_contacts(); }
    bool has_contacts() const { return collider_->finds_contacts() || narrow_.has_value(); }
    PairList pairs() const;     ///< if it has them
    PairList contacts() const;  ///< likewise
    std::map<std::string, double> counters() const;

    const Collider& collider() const { return *collider_; }

private:
    TreeUpdate update_after(Motion motion) const;
    std::size_t updated(TreeUpdate how) const;  ///< objects
    void enqueue(const Input& input);
    bool complete();

    Session& session_;
    BuilderChoice choice_;  ///< a builder may keep looking at its words
    unsigned rules_off_;
    std::unique_ptr<Builder> builder_;  ///< its own, whose tree stands from frame to frame; null if none is wanted
    const Tree* tree_ = nullptr;
    std::vector<TreeUpdate> updates_;  ///< what becomes of each object's tree
    OrderTrials trials_;
    std::unique_ptr<Collider> collider_;
    std::optional<NarrowPhase> narrow_;
};

}  // namespace bvhbench
