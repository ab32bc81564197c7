// SPDX-License-Identifier: MIT
//
// Frames of a pipeline under the rule `margin` (collide/margin/margin.h).
#include <utility>

#include "collide/device_lists.h"
#include "geometry/error.h"
#include "harness/measure/pipeline.h"

namespace bvhbench {

/// Decides what the frame does. Trees are then rebuilt over boxes with room, or not touched.
void Pipeline::begin_margin(const Input& input)
{
    if (!margin_)
        return;
    Queue& queue = session_.queue();
    does_ = margin_->begin(input, queue);
    const bool knows_contacts = std::exchange(has_all_contacts_, false);
    if (is_plain())
        return;
    if (standing_) {
        std::optional<DevicePairs> contacts;
        if (knows_contacts && margin_->mostly_rests())
            contacts = narrow_->device_contacts();
        standing_->begin(input, contacts, margin_->found().pairs.size(), queue);
    }
    if (entering_) {
        entering_.reset();
        reserve_for(input);
    }
    updates_.assign(updates_.size(),
                    does_ == MarginFrame::served ? TreeUpdate::keep : TreeUpdate::rebuild);
}

/// Enqueues a frame from the list, which is made anew if it does not serve.
void Pipeline::enqueue_margin(const Input& input)
{
    Queue& queue = session_.queue();
    const bool serves = margin_->still_serves(input, queue);
    if (does_ == MarginFrame::served && !serves)
        throw Unavailable("a vertex has left its room since memory was taken for the frame");
    if (does_ == MarginFrame::renewed)
        enqueue_query(margin_->with_room(input, queue));
    margin_->filter(collider_->device_pairs(queue), listed_, input, queue);
}

/// Enqueues the narrow phase. In frames of the rule, contacts may stand.
void Pipeline::enqueue_narrow(const Input& input)
{
    Queue& queue = session_.queue();
    DevicePairs pairs = device_pairs();
    if (!is_plain()) {
        standing_->pick(pairs, listed_, margin_->points_before(), input, queue);
        pairs = standing_->to_test(pairs);
    }
    narrow_->query(input, pairs.pairs, pairs.counters, queue);
    if (!is_plain())
        standing_->append_to(narrow_->device_contacts(), queue);
}

/// Returns the pairs that the narrow phase tested.
std::vector<Pair> Pipeline::tested_pairs() const
{
    if (is_plain())
        return found_pairs();
    const DevicePairs list = standing_->to_test(margin_->found());
    return first_entries(list.pairs, wide_counts(list.counters, session_.queue()).front(),
                         session_.queue(), "the pairs tested");
}

std::vector<Pair> Pipeline::found_pairs() const
{
    return is_plain() ? collider_->pairs(session_.queue()) : margin_->pairs(session_.queue());
}

std::uint64_t Pipeline::pair_count() const
{
    const Queue& queue = session_.queue();
    return is_plain() ? collider_->counts(queue).pairs : margin_->count(queue);
}

}  // namespace bvhbench
