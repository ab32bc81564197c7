// SPDX-License-Identifier: MIT
//
// A frame of a scene that is distributed over ranks: from each rank's triangles to all pairs of the scene, each found once.
//
//     build      the rank's tree, over padded boxes if there is a distance, and the boxes that it tells the others
//     boxes      all ranks tell their boxes
//     select     triangles that meet another rank's boxes
//     exchange   they are sent there; meanwhile the device tests the rank's own triangles
//     self       the rest of that query
//     halo       triangles that came are tested against the tree
//     narrow     if asked for: which of the pairs intersect, or are within the distance
//
// Pairs stay on the rank and device that found them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "builders/builder.h"
#include "cluster/contacts.h"
#include "cluster/halo_query.h"
#include "cluster/leaving.h"
#include "cluster/ranks.h"
#include "cluster/share.h"
#include "cluster/top_boxes.h"
#include "collide/collider.h"
#include "collide/oracles/pair_sets.h"

namespace bvhbench {

/// Stages of a frame, in order.
inline constexpr std::string_view frame_stages[] = {"build", "boxes", "select", "exchange",
                                                    "self",  "halo",  "narrow"};
inline constexpr std::size_t frame_stage_count = std::size(frame_stages);

/// What a frame took on one rank, and what it sent.
struct RankFrame {
    std::int64_t whole_ns = 0;  ///< host clock
    std::int64_t host_ns[frame_stage_count] = {};
    std::int64_t device_ns[frame_stage_count] =
        {};                           ///< launches of the stage; self: all of its query
    std::uint64_t sent_bytes = 0;     ///< boxes and halo, to other ranks
    std::uint64_t halo_sent = 0;      ///< triangles, once for each rank that they went to
    std::uint64_t halo_received = 0;  ///< triangles
    std::uint64_t own_pairs = 0;      ///< between triangles of the rank
    std::uint64_t halo_pairs = 0;     ///< between its triangles and others
    std::uint64_t contacts = 0;       ///< pairs that the narrow phase kept; 0 without one
};

/// One rank's part of frames over a distributed scene.
class DistributedFrame {
public:
    /// `builder` and `collider` serve this object alone. Throws BadUsage for a collider that queries no tree or keeps state between
    /// frames. `collider` must have been told about adjacent pairs as `test` is. `boxes`: how many the rank tells the others, as TopBoxes
    /// takes them.
    DistributedFrame(Ranks& ranks, Programs& programs, Queue& queue, Builder& builder,
                     Collider& collider, const PairTest& test, uint boxes = usual_top_boxes);
    DistributedFrame(const DistributedFrame&) = delete;
    DistributedFrame& operator=(const DistributedFrame&) = delete;

    /// Takes the rank's triangles, any number of them, and reserves memory for frames over them. Never timed. Throws Unavailable,
    /// BadUsage for a builder whose trees are in host memory, and what builder and collider throw.
    void take(Share share);

    /// Moves the share's points, which stay as many. Never timed. Blocks.
    void move(std::vector<Point> points);

    /// Calls `begins` with the name of each stage when it begins.
    void tell_stages(std::function<void(std::string_view)> begins) { begins_ = std::move(begins); }

    /// Runs a frame; all ranks must. Buffers that are too small grow, and their query is repeated.
    RankFrame run();

    /// Returns the pairs that this rank found in the last frame, by scene numbers: smaller first, in no order. Blocks.
    std::vector<Pair> pairs() const;

    /// Returns those of them that the narrow phase kept, all if there is none. Blocks.
    std::vector<Pair> contacts() const;

    /// Returns what identifies those pairs, without copying them to the host. Blocks.
    PairFacts facts();

    /// Returns those pairs that have a triangle of the sample, by scene numbers. Blocks.
    std::vector<Pair> pairs_of(const TriangleSample& sample);

    /// Returns the right pairs, by scene numbers, of the sample's triangles with triangles of this rank: the device compares the box
    /// of every triangle of the sample, which all ranks exchange, with all of the rank's. Of two triangles of the sample,
    /// the greater one's rank has the pair. All ranks must. Blocks.
    std::vector<Pair> right_pairs_of(const TriangleSample& sample);

    const Share& share() const { return share_; }

private:
    /// In the order of frame_stages.
    enum Stage : std::size_t {
        in_build,
        in_boxes,
        in_select,
        in_exchange,
        in_self,
        in_halo,
        in_narrow
    };
    bool has_tree() const { return share_.triangle_count() > 1; }
    const Input& boxed() const { return padded_ ? *padded_ : *input_; }
    void build_tree(Queue& queue);
    std::vector<Aabb> build();
    Aabb own_box(std::size_t k) const;
    void start_selecting(WantedBoxes wanted);
    void query_leaving();
    std::vector<Pair> selected();
    void pack(std::size_t count);
    void exchange(const std::vector<Pair>& leaving, RankFrame& frame);
    void start_halo();
    void find_halo();
    void find_contacts();
    Queue& queue_of(Stage stage) { return stage_queues_[stage]; }
    template <class OnDevice>
    void on_named_pairs(const OnDevice& work);
    uint scene_id(uint k) const;
    Pair scene_pair(Pair pair) const;

    Ranks& ranks_;
    Programs& programs_;
    Queue& queue_;
    std::vector<Queue> stage_queues_;  ///< all are `queue_`; each keeps the times of one stage
    Queue beside_;                     ///< for reads and uploads while `queue_` is at work
    Builder& builder_;
    Collider& collider_;
    bool keep_adjacent_;
    float reach_;  ///< of padded boxes, to each side
    uint box_count_;
    std::function<void(std::string_view)> begins_ = [](std::string_view) {};
    TopBoxes tops_;
    Leaving leaving_;
    WantedBoxes wanted_;  ///< of the last search
    HaloQuery halo_query_;
    std::optional<RankContacts> contacts_;
    Share share_;
    std::optional<Input> input_;
    std::optional<Input> padded_;  ///< what the tree is over, if there is a distance
    const DeviceTree* tree_ = nullptr;
    // Kept from frame to frame, because new pages take longer than the messages.
    std::vector<HaloTriangle> packed_, sent_;  ///< triangles that leave, as found and by rank
    std::vector<HaloCorners> sent_corners_;
    std::vector<HaloTriangle> halo_;  ///< of the last frame
    std::vector<HaloCorners> halo_corners_;
    std::vector<Pair> pairs_of_one_;  ///< its pairs with the halo, if the rank has one triangle
};

}  // namespace bvhbench
