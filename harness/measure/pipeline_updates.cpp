// SPDX-License-Identifier: MIT
//
// Which trees of a pipeline are rebuilt, refitted or kept, and which triangles enter them.
#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "harness/measure/pipeline.h"

namespace bvhbench {
/// Box tests, over those with new trees, up to which the rule `deforming` refits. A refit takes less than half of a build.
constexpr double most_more_tests = 1.15;

void Pipeline::begin_frame(std::span<const Motion> motions)
{
    // A collider that is not told of the next frame begins it as a first one.
    const TreeUpdate asked = collider_->keeps_tree() && update_ != FrameUpdate::rebuild
                                 ? collider_->next_frame()
                             : update_ == FrameUpdate::refit && has_begun_ ? TreeUpdate::refit
                                                                           : TreeUpdate::rebuild;
    has_begun_ = true;
    if (!is_plain())  // the tree is over boxes with room
        motions = {};
    if (builder_ == nullptr)
        return;
    if (collider_->keeps_tree() || update_ == FrameUpdate::refit) {
        updates_ = builder_->plan_update(std::vector(updates_.size(), asked), session_.queue());
    } else if (entering_) {
        const bool keeps_all = skips(skip_unchanged) && queries() && !motions.empty() &&
                               motion_of_all(motions) == Motion::unchanged;
        updates_.assign(updates_.size(), keeps_all ? TreeUpdate::keep : TreeUpdate::rebuild);
    } else if (one_tree_ && !motions.empty()) {
        const Motion whole = motion_of_all(motions);
        updates_ = planned_updates({&whole, 1});
    } else {
        updates_ = planned_updates(motions);
    }
}

std::vector<TreeUpdate> Pipeline::planned_updates(std::span<const Motion> motions)
{
    std::vector<TreeUpdate> wanted(updates_.size(), TreeUpdate::rebuild);
    const bool may_refit = skips(skip_deforming) && builder_->can_refit() && tests_of_new_ > 0 &&
                           last_tests_ <= most_more_tests * tests_of_new_;
    is_worn_.resize(updates_.size());
    for (std::size_t k = 0; k < motions.size(); ++k)
        if (skips(skip_unchanged) && motions[k] == Motion::unchanged)
            wanted[k] = TreeUpdate::keep;
        else if (skips(skip_rigid) && motions[k] <= Motion::rigid && builder_->can_refit())
            wanted[k] = TreeUpdate::refit;
        else if (may_refit) {
            wanted[k] = TreeUpdate::refit;
            is_worn_[k] = true;
        }
    const std::vector<TreeUpdate> planned = builder_->plan_update(wanted, session_.queue());
    for (std::size_t k = 0; k < planned.size(); ++k)
        if (planned[k] == TreeUpdate::rebuild)
            is_worn_[k] = false;
    return planned;
}

/// Decides whether the rule `near` applies to this frame. Memory is reserved for the triangles that enter, and counting them
/// takes work of the device. That happens here, outside the timing; a simulation would use the count of the previous frame.
void Pipeline::choose_entering(const Input& input)
{
    if (!near_ || std::count(updates_.begin(), updates_.end(), TreeUpdate::rebuild) == 0)
        return;
    Queue& queue = session_.queue();
    std::vector<uint> counts = near_->find(input, queue);
    queue.finish();
    const std::size_t total = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
    if (total > NearTriangles::most_of(input.triangle_count())) {
        if (entering_) {
            entering_.reset();
            reserve_for(input);
            updates_ = planned_updates({});
        }
        return;
    }
    updates_.assign(updates_.size(), TreeUpdate::rebuild);
    const bool has_memory = entering_ && entering_->counts == counts;
    entering_.emplace();
    entering_->input = near_->frame(input, counts, entering_->faces, queue);
    entering_->counts = std::move(counts);
    if (!has_memory && entering_->has_pairs())
        reserve_for(entering_->input);
}

/// Notes the box tests of a frame, by which the rule `deforming` decides on the next.
void Pipeline::note_tests()
{
    if (!skips(skip_deforming) || !is_plain() || entering_)
        return;
    last_tests_ = static_cast<double>(collider_->counts(session_.queue()).box_tests.value_or(0));
    if (std::ranges::none_of(is_worn_, std::identity()))
        tests_of_new_ = last_tests_;
}

}  // namespace bvhbench
