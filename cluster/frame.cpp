// SPDX-License-Identifier: MIT
#include "cluster/frame.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "cluster/frame_clock.h"
#include "cluster/reach.h"
#include "collide/device_lists.h"
#include "collide/oracles/host_collider.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

/// Waits for the queue and returns what its launches took since the last call. Throws BadClock.
std::int64_t device_ns(Queue& queue)
{
    std::int64_t sum = 0;
    for (const StageTime& stage : queue.finish())
        sum += stage.elapsed_ns();
    queue.check_times();
    return sum;
}

}  // namespace

DistributedFrame::DistributedFrame(Ranks& ranks, Programs& programs, Queue& queue, Builder& builder,
                                   Collider& collider, const PairTest& test, uint boxes)
    : ranks_(ranks)
    , programs_(programs)
    , queue_(queue)
    , stage_queues_(frame_stage_count, Queue(programs.device(), queue.cl()))
    , beside_(programs.device())
    , builder_(builder)
    , collider_(collider)
    , keep_adjacent_(test.keep_adjacent)
    , reach_(reach_of(test.distance.value_or(0)))
    , box_count_(boxes)
    , tops_(programs, boxes)
    , leaving_(programs, !test.keep_adjacent || test.decides())
    , halo_query_(programs, test.keep_adjacent)
{
    const std::string name(collider.card().name);
    if (!collider.needs_tree())
        throw BadUsage("collider " + name +
                       " queries no tree, which triangles of other ranks are tested against");
    if (collider.keeps_tree())
        throw BadUsage("collider " + name + " follows frames, and ranks find pairs of one");
    if (test.decides())
        contacts_.emplace(programs, test);
}

void DistributedFrame::take(Share share)
{
    share_ = std::move(share);
    input_.reset();
    padded_.reset();
    halo_.clear();
    if (contacts_)
        contacts_->take(share_, queue_);
    if (!has_tree())
        return;
    input_ = upload(programs_.device(), queue_, share_.points, share_.faces);
    builder_.reserve(share_.triangle_count());
    build_tree(queue_);
    queue_.finish();
    if (tree_ == nullptr)
        throw BadUsage("builder " + std::string(builder_.card().name) +
                       " leaves its tree in host memory, and ranks test triangles of others on "
                       "their device");
    collider_.reserve(tree_, boxed());
    tops_.reserve(*tree_);
    leaving_.own(share_);
    leaving_.reserve(nullptr, *input_);
    if (!keep_adjacent_) {
        std::vector<Face> faces;
        for (std::size_t k = 0; k < share_.faces.size(); ++k)
            faces.push_back(share_.scene_face(k));
        halo_query_.own(std::move(faces));
    }
    halo_query_.reserve(tree_, boxed());
}

void DistributedFrame::move(std::vector<Point> points)
{
    assert(points.size() == share_.points.size());
    share_.points = std::move(points);
    if (contacts_)
        contacts_->take(share_, queue_);
    if (!has_tree())
        return;
    input_->device_points.upload(queue_.cl(), share_.points);
    input_->points = share_.points;
}

RankFrame DistributedFrame::run()
{
    RankFrame frame;
    for (Queue& queue : stage_queues_)
        queue.forget();  // of a frame that failed
    ranks_.wait_for_all();
    const std::size_t stages = contacts_ ? frame_stage_count : frame_stage_count - 1;
    FrameClock clock(frame, stages, begins_);
    const std::vector<Aabb> own = build();
    clock.end_stage();

    const std::vector<Aabb> tops = gathered<Aabb>(ranks_, own);
    frame.sent_bytes = (ranks_.count() - 1) * own.size() * sizeof(Aabb);
    clock.end_stage();

    // The device goes on with the own triangles while the host reads which leave.
    start_selecting(wanted_from(ranks_.rank(), tops, ranks_.count()));
    if (has_tree()) {
        collider_.query(tree_, boxed(), queue_of(in_self));
        queue_.cl().flush();
    }
    const std::vector<Pair> leaving = selected();
    clock.end_stage();

    exchange(leaving, frame);
    clock.end_stage();

    // It goes on with the halo as well while the host reads whether the lists had room.
    if (has_tree()) {
        start_halo();
        while (!collider_.complete(beside_)) {
            collider_.query(tree_, boxed(), queue_of(in_self));
            beside_.run_after(queue_);
        }
    }
    clock.end_stage();

    find_halo();
    clock.end_stage();

    if (contacts_) {
        find_contacts();
        clock.end_stage();
        frame.contacts = contacts_->count(queue_);
    }
    for (std::size_t stage = 0; stage < frame_stage_count; ++stage)
        frame.device_ns[stage] = device_ns(stage_queues_[stage]);
    if (has_tree())
        frame.own_pairs = collider_.counts(queue_).pairs;
    frame.halo_pairs = !has_tree()     ? pairs_of_one_.size()
                       : halo_.empty() ? 0
                                       : halo_query_.counts(queue_).pairs;
    return frame;
}

/// Builds the tree, which is null if it is not on the device.
void DistributedFrame::build_tree(Queue& queue)
{
    if (contacts_)
        padded_ = contacts_->padded(*input_, queue);
    tree_ = dynamic_cast<const DeviceTree*>(&builder_.build(boxed(), queue));
}

/// Returns the boxes that this rank tells the others.
std::vector<Aabb> DistributedFrame::build()
{
    if (has_tree()) {
        build_tree(queue_of(in_build));
        return tops_.read(*tree_, queue_of(in_build));
    }
    std::vector<Aabb> own(box_count_, empty_box());
    if (share_.triangle_count() == 1)
        own[0] = own_box(0);
    return own;
}

/// Returns the box of triangle k that pairs are found by.
Aabb DistributedFrame::own_box(std::size_t k) const
{
    return padded(face_box(share_.points, share_.faces[k]), reach_);
}

/// Enqueues the search for triangles whose boxes, padded if there is a distance, may overlap the wanted ones, which are. Lets what follows in
/// `beside_` run after it.
void DistributedFrame::start_selecting(WantedBoxes wanted)
{
    wanted_ = std::move(wanted);
    for (Aabb& box : wanted_.boxes)
        box = padded_again(box, reach_);
    if (!has_tree() || wanted_.ranks.empty())
        return;
    leaving_.want(wanted_, queue_of(in_select));
    query_leaving();
}

void DistributedFrame::query_leaving()
{
    leaving_.query(nullptr, *input_, queue_of(in_select));
    beside_.run_after(queue_);
}

/// Returns the triangles that were found, with the rank that each leaves to.
std::vector<Pair> DistributedFrame::selected()
{
    if (wanted_.ranks.empty())
        return {};
    if (!has_tree())
        return leaving(face_boxes(share_.points, share_.faces), wanted_);
    while (!leaving_.complete(beside_))
        query_leaving();
    return leaving_.pairs(beside_);
}

/// Puts the triangles of what `selected` returned into `packed_`.
void DistributedFrame::pack(std::size_t count)
{
    if (has_tree())
        return leaving_.read_packed(packed_, count, beside_);
    packed_.assign(count, {});
    for (HaloTriangle& own : packed_)
        own = {face_box(share_.points, share_.faces[0]), share_.ids[0], share_.scene_face(0)};
}

void DistributedFrame::exchange(const std::vector<Pair>& leaving, RankFrame& frame)
{
    pack(leaving.size());
    std::vector<std::uint64_t> counts(ranks_.count()), next(ranks_.count());
    for (const Pair& one : leaving)
        ++counts[one.b];
    std::exclusive_scan(counts.begin(), counts.end(), next.begin(), std::uint64_t{0});
    sent_.resize(leaving.size());
    sent_corners_.resize(contacts_ ? leaving.size() : 0);
    for (std::size_t k = 0; k < leaving.size(); ++k) {
        const std::uint64_t place = next[leaving[k].b]++;
        sent_[place] = packed_[k];
        if (contacts_) {
            const Face face = share_.faces[leaving[k].a];
            sent_corners_[place] = {
                {share_.points[face.a], share_.points[face.b], share_.points[face.c]}};
        }
    }
    exchange_by_rank<HaloTriangle>(ranks_, sent_, counts, halo_);
    if (reach_ > 0)
        for (HaloTriangle& one : halo_)
            one.box = padded(one.box, reach_);
    if (contacts_)
        exchange_by_rank<HaloCorners>(ranks_, sent_corners_, counts, halo_corners_);
    frame.halo_sent = leaving.size();
    frame.sent_bytes +=
        sent_.size() * sizeof(HaloTriangle) + sent_corners_.size() * sizeof(HaloCorners);
    frame.halo_received = halo_.size();
}

/// Enqueues the test of the halo against the tree, and lets what follows in `beside_` run after all that was enqueued before.
void DistributedFrame::start_halo()
{
    if (!halo_.empty())
        halo_query_.bring(halo_, beside_);
    beside_.run_after(queue_);
    if (!halo_.empty())
        halo_query_.query(tree_, boxed(), queue_of(in_halo));
    queue_.cl().flush();
}

void DistributedFrame::find_halo()
{
    pairs_of_one_.clear();
    if (halo_.empty())
        return;
    if (has_tree()) {
        while (!halo_query_.complete(queue_))
            halo_query_.query(tree_, boxed(), queue_of(in_halo));
        return;
    }
    for (uint k = 0; k < halo_.size(); ++k)
        if (overlap(own_box(0), halo_[k].box) &&
            (keep_adjacent_ || !share_a_vertex(share_.scene_face(0), halo_[k].vertices)))
            pairs_of_one_.push_back({0, 1 + k});
}

void DistributedFrame::find_contacts()
{
    Queue& queue = queue_of(in_narrow);
    contacts_->bring(share_, halo_, halo_corners_, queue);
    std::optional<DevicePairs> own, with_halo;
    if (has_tree()) {
        own = collider_.device_pairs(queue);
        if (!halo_.empty())
            with_halo = halo_query_.device_pairs(queue);
    } else if (!pairs_of_one_.empty()) {
        with_halo = room_for_pairs(programs_.device(), pairs_of_one_.size());
        copy_pairs(pairs_of_one_, *with_halo, queue);
    }
    contacts_->find(own ? &*own : nullptr, with_halo ? &*with_halo : nullptr, queue);
}

}  // namespace bvhbench
