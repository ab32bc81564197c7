// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "collide/narrow/narrow.h"
#include "collide/near.h"
#include "harness/record/record.h"
#include "harness/session/session.h"
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
    /// if it goes on from frame to frame, else as the rules `unchanged` and `rigid` allow (skips.h). What the
    /// rule `near` has left stands for a frame of which all is unchanged, and is no tree of all to be brought along.
    void begin_frame(std::span<const Motion> motions);

    /// One whole frame, again and again until nothing lacked room, with memory for what enters it. Waits.
    void settle(const Input& input);

    /// One whole frame, in its stages. Waits. Throws Unavailable if it lacked room, which one that was settled over the
    /// same points does not.
    std::vector<StageTime> once(const Input& input);

    /// Of the last frame. All wait.
    bool has_pairs() const { return !collider_->finds_contacts(); }
    bool has_contacts() const { return collider_->finds_contacts() || narrow_.has_value(); }
    PairList pairs() const;     ///< if it has them
    PairList contacts() const;  ///< if it has them
    std::map<std::string, double> counters() const;

    const Collider& collider() const { return *collider_; }
    /// That the last frame queried; null if none is wanted.
    const Tree* tree() const { return tree_; }

private:
    /// What enters a frame under the rule `near`: some of the triangles, of those objects that have any.
    struct Entering {
        std::vector<uint> counts;  ///< of each object of the whole frame
        std::vector<Face> faces;
        Input input;

        bool has_pairs() const { return input.objects.size() > 1; }
    };

    bool skips(SkipRule rule) const { return (rules_off_ & rule) == 0; }
    void reserve_for(const Input& input);
    void choose_entering(const Input& input);
    bool queries() const { return !entering_ || entering_->has_pairs(); }
    TreeUpdate update_after(Motion motion) const;
    bool keeps_all(std::span<const Motion> motions) const;
    std::vector<TreeUpdate> planned_updates(std::span<const Motion> motions);
    std::size_t updated(TreeUpdate how) const;  ///< objects
    void enqueue(const Input& input);
    void enqueue_query(const Input& input);
    bool complete();
    void declare_found(std::vector<StageTime>& stages) const;

    Session& session_;
    BuilderChoice choice_;  ///< a builder may keep looking at its words
    unsigned rules_off_;
    /// Its own, whose tree stands from frame to frame; null if none is wanted.
    std::unique_ptr<Builder> builder_;
    const Tree* tree_ = nullptr;
    std::vector<TreeUpdate> updates_;  ///< what becomes of each object's tree
    std::unique_ptr<Collider> collider_;
    std::optional<NarrowPhase> narrow_;
    std::optional<NearTriangles> near_;  ///< if the rule may apply
    std::optional<Entering> entering_;   ///< if it does; else everything enters
    std::int64_t corner_bytes_ = 0;  ///< of the triangles in the pairs that the frame settled with
};

}  // namespace bvhbench
