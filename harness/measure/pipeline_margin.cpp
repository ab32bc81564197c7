// SPDX-License-Identifier: MIT
//
// Frames of a pipeline under the rule `margin` (collide/margin/margin.h).
#include "geometry/error.h"
#include "harness/measure/pipeline.h"

namespace bvhbench {

/// Decides what the frame does. Trees are then rebuilt over boxes with room, or not touched.
void Pipeline::begin_margin(const Input& input)
{
    if (!margin_)
        return;
    does_ = margin_->begin(input, session_.queue());
    if (is_plain())
        return;
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
