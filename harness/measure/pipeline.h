// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "baselines/radix/uploaded.h"
#include "collide/margin/margin.h"
#include "collide/narrow/narrow.h"
#include "collide/near.h"
#include "collide/standing/standing.h"
#include "collide/within/within.h"
#include "harness/choice/catalog.h"
#include "harness/measure/one_tree.h"
#include "harness/session/session.h"
#include "scenes/motion.h"

namespace bvhbench {

/// Turns a frame's vertices into pairs or contacts: a builder if the collider needs a tree, the collider, and a narrow phase if
/// one is chosen and the collider does not find contacts itself.
class Pipeline {
public:
    /// Compiles and reserves memory for frames like `input`. Throws what builders and colliders throw.
    Pipeline(Session& session, const BuilderChoice& builder, const ColliderChoice& collider,
             const Input& input);

    /// Begins a frame whose points differ from those of the last prepared frame. `motions` has the motion of each object since
    /// then; it is empty for the first frame and where motions are unknown. Plans the tree updates: what the collider asks for
    /// if it keeps its tree from frame to frame, else what the rules `unchanged` and `rigid` allow (skips.h). A tree that the
    /// rule `near` built holds some triangles only: it is kept if all objects are unchanged, and else rebuilt, never refitted.
    void begin_frame(std::span<const Motion> motions);

    /// Runs the whole frame until its queries are complete, and reserves memory for the triangles that enter it. Returns the stages of
    /// the last run, which may include compiling. Blocks until done.
    std::vector<StageTime> prepare(const Input& input);

    /// Runs the whole frame once and returns its stages. Blocks until done. Throws Unavailable if a buffer overflows, which
    /// cannot happen after prepare() over the same points.
    std::vector<StageTime> once(const Input& input);

    /// Results of the last frame. All of these functions block until it is done.
    bool has_pairs() const { return !collider_->finds_contacts(); }
    /// As WithinPhase::distance_errors; empty if no distance is asked for.
    std::vector<double> distance_errors(const Input& input) const
    {
        return within_ ? within_->distance_errors(input, session_.queue()) : std::vector<double>();
    }
    bool has_contacts() const { return collider_->finds_contacts() || narrow_ || within_; }
    std::vector<Pair> pairs() const;     ///< in any order; requires has_pairs()
    std::vector<Pair> contacts() const;  ///< in any order; requires has_contacts()
    /// Of the contacts between two frames, sorted by their pairs, NarrowPhase::impact_times(). Empty for contacts of one frame.
    std::vector<float> impact_times() const;
    std::map<std::string, double> counters() const;

    bool is_on_device() const { return !collider_->is_on_host() || narrow_; }  ///< at least in part
    void upload(const Input& input) const;  ///< copies the frame's points to the device; waits
    void read_back() const;                 ///< copies the answer into new memory of the host

    /// Host times, in ns, of what no stage of a sample on the device includes: `upload_ns` and, if the host has room for the answer,
    /// `read_back_ns`; each the median of up to five. Empty if no part of the pipeline runs on the device.
    std::map<std::string, double> transfers(const Input& input) const;

    /// Pairs in device memory, as many as counters() has. Requires has_pairs(), and a frame with triangles to query.
    DevicePairs device_pairs()
    {
        return is_plain() ? collider_->device_pairs(session_.queue()) : margin_->found();
    }

    const Collider& collider() const { return *collider_; }
    /// Tree that the last frame queried; null if the collider needs none.
    const Tree* tree() const { return tree_; }

private:
    /// Triangles that enter a frame under the rule `near`, of the objects that have any.
    struct Entering {
        std::vector<uint> counts;  ///< triangles of each object of the whole frame that enter
        std::vector<Face> faces;
        Input input;

        bool has_pairs() const { return input.objects.size() > 1; }
    };

    bool skips(SkipRule rule) const { return (rules_off_ & rule) == 0; }
    void reserve_for(const Input& input);
    void take_tree(const Tree& tree, const Input& of_trees);
    void choose_entering(const Input& input);
    bool queries() const { return !entering_ || entering_->has_pairs(); }
    bool is_plain() const { return does_ == MarginFrame::plain; }
    void begin_margin(const Input& input);
    std::uint64_t pair_count() const;
    std::vector<Pair> found_pairs() const;
    std::vector<TreeUpdate> planned_updates(std::span<const Motion> motions);
    void enqueue(const Input& input);
    void note_tests();
    void enqueue_margin(const Input& input);
    void enqueue_narrow(const Input& input);
    std::vector<Pair> tested_pairs() const;
    void enqueue_query(const Input& input);
    bool complete();
    void declare_found(std::vector<StageTime>& stages) const;

    Session& session_;
    BuilderChoice choice_;
    unsigned rules_off_ = 0;  ///< rules of skips.h that are not used, by choice or on this device
    FrameUpdate update_;
    bool has_begun_ = false;           ///< whether a frame has begun
    std::optional<OneTree> one_tree_;  ///< if one tree is over several objects
    /// This pipeline's own builder, so that its tree persists between frames; null if the collider needs none.
    std::unique_ptr<Builder> builder_;
    UploadedTree uploaded_;  ///< of a builder whose trees are on the host
    const Tree* tree_ = nullptr;
    std::vector<TreeUpdate> updates_;  ///< planned update of each tree
    /// Of each tree, whether the rule `deforming` has refitted it since it was rebuilt.
    std::vector<bool> is_worn_;
    double last_tests_ = 0;    ///< box tests of the last frame
    double tests_of_new_ = 0;  ///< of the last frame without worn trees
    std::unique_ptr<Collider> collider_;
    std::optional<NarrowPhase> narrow_;
    /// If pairs within a distance are asked for, in place of narrow_.
    std::optional<WithinPhase> within_;
    std::optional<Padding> padding_;            ///< if features are kept a separation apart
    float reach_ = 0;                           ///< of the padding, to each side
    std::optional<NearTriangles> near_;         ///< if the rule `near` may apply
    std::optional<Entering> entering_;          ///< if the rule applies; else all triangles enter
    std::optional<MarginPairs> margin_;         ///< if the rule `margin` may apply
    std::optional<StandingContacts> standing_;  ///< if both margin_ and narrow_ are there
    MarginFrame does_ = MarginFrame::plain;     ///< what this frame does under that rule
    std::size_t listed_ = 0;                    ///< pairs on its list
    bool has_all_contacts_ = false;  ///< whether narrow_ has those of the last prepared frame
    std::uint64_t tested_ = 0;       ///< pairs that the narrow phase tests in the prepared frame
    std::int64_t corner_bytes_ = 0;  ///< bytes that the narrow phase reads for these pairs
};

}  // namespace bvhbench
