// SPDX-License-Identifier: MIT
#include "collide/margin/margin.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "builders/device_tree.h"
#include "collide/counters.h"
#include "collide/device_lists.h"
#include "collide/parameters.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr auto margin_path = "collide/margin/margin.cl";
constexpr uint margin_group_size = 64, block_pairs = 512;

/// Pairs that a work-item of the group form filters: as many as its group has room for each.
constexpr uint pairs_each = 8;

/// Room of a vertex: its way in as many frames as a quarter of a triangle's side is long, and a tenth of that way to all sides. With a
/// whole side, lists have 5 to 28 times as many pairs as are found (cloth_ball and n-body, interpolated), with a quarter 1.5 to 2.
constexpr double room_a_side = 0.25;
constexpr float slack = 0.1f;

/// Room that each vertex has in any case, of a triangle's side: one at rest may begin to move, and one may turn.
constexpr double skin_a_side = 0.02;

/// Frames that room is given for. A list of fewer does not pay: filtering takes two thirds of a frame on two cores.
constexpr double least_frames = 6, most_frames = 16;

/// Returns the mean of the longest sides of the boxes of all triangles.
double mean_side(const Input& input)
{
    double sum = 0;
    for (const Face& face : input.faces) {
        const Aabb box = face_box(input.points, face);
        sum += std::max({box.max_x - box.min_x, box.max_y - box.min_y, box.max_z - box.min_z});
    }
    return sum / static_cast<double>(std::max<std::size_t>(1, input.faces.size()));
}

/// Returns the mean of the vertices' ways from `before` to `now`, each along its longest axis.
double mean_way(std::span<const Point> before, std::span<const Point> now)
{
    double sum = 0;
    for (std::size_t k = 0; k < now.size(); ++k)
        sum += std::max({std::abs(now[k].x - before[k].x), std::abs(now[k].y - before[k].y),
                         std::abs(now[k].z - before[k].z)});
    return sum / static_cast<double>(std::max<std::size_t>(1, now.size()));
}

/// Returns how many vertices have not moved.
std::size_t resting(std::span<const Point> before, std::span<const Point> now)
{
    std::size_t count = 0;
    for (std::size_t k = 0; k < before.size(); ++k)
        count += before[k].x == now[k].x && before[k].y == now[k].y && before[k].z == now[k].z;
    return count;
}

/// Most plain frames after a list that served none.
constexpr int most_pause = 15;

}  // namespace

MarginPairs::MarginPairs(Programs& programs, KernelForm form)
    : programs_(programs)
    , form_(chosen_form(programs.device(), form))
    , chunks_(chunk_count(programs.device()))
    , bounds_(programs, form_)
{
    const std::vector<Define> defines =
        form_ == KernelForm::groups
            ? std::vector<Define>{{"GROUP_SIZE", margin_group_size}, {"PAIRS_EACH", pairs_each}}
            : std::vector<Define>{{"SINK_BLOCK", block_pairs}};
    check_ = programs.kernel(margin_path, "check_room", defines);
    give_ = programs.kernel(margin_path, "give_room", defines);
    filter_ = programs.kernel(margin_path, "filter_listed", defines);
}

void MarginPairs::reserve(const Input& input)
{
    take_memory(arena_, programs_.device(), [&](Arena& arena) {
        bounds_.plan(arena, input.triangle_count(), Use::scratch);
        for (Buffer<Point>* points : {&before_, &now_, &low_, &high_})
            *points = arena.take<Point>(input.device_points.size(), Use::scratch);
        outside_ = arena.take<uint>(1, Use::scratch);
        counters_ = arena.take<uint>(QUEUES_COUNT, Use::scratch);
        blocks_ =
            arena.take<Pair>(form_ == KernelForm::groups ? 1 : block_pairs * chunks_, Use::scratch);
    });
    bounds_.prepare(cl::CommandQueue(programs_.device().context, programs_.device().cl));
    pair_room_ = programs_.device().room_for(std::max<std::size_t>(1024, input.triangle_count()),
                                             sizeof(Pair));
    take_pairs();
}

void MarginPairs::take_pairs()
{
    take_memory(pairs_arena_, programs_.device(),
                [&](Arena& arena) { pairs_ = arena.take<Pair>(pair_room_, Use::scratch); });
}

std::size_t MarginPairs::bytes() const
{
    return arena_ ? arena_->used().total() + pairs_arena_->used().total() : 0;
}

MarginFrame MarginPairs::begin(const Input& input, Queue& queue)
{
    assert(arena_ && input.device_points.size() == now_.size());
    std::swap(before_, now_);
    queue.begin("margin");
    queue.copy(input.device_points.cl(), now_.cl(), 0, now_.bytes());
    const bool serves = served_ >= 0 && still_serves(input, queue);
    queue.finish();
    const std::vector<Point> before =
        std::exchange(host_points_, {input.points.begin(), input.points.end()});
    mostly_rests_ = 2 * resting(before, input.points) >= input.points.size();
    if (serves) {
        ++served_;
        return MarginFrame::served;
    }
    if (served_ == 0)
        plain_left_ = pause_ = std::min(most_pause, 2 * pause_ + 1);
    else if (served_ > 0)
        pause_ = 0;
    served_ = -1;
    if (plain_left_ > 0)
        --plain_left_;
    else if (can_renew(input, before))
        return MarginFrame::renewed;
    return MarginFrame::plain;
}

/// Decides how much room vertices get, given the points of the frame before. True if a list pays.
bool MarginPairs::can_renew(const Input& input, std::span<const Point> before)
{
    if (before.empty())
        return false;
    const double side = mean_side(input);
    skin_ = static_cast<float>(skin_a_side * side);
    frames_ = static_cast<float>(
        std::min(most_frames, room_a_side * side / mean_way(before, input.points)));
    served_ = frames_ >= least_frames ? 0 : -1;
    return served_ == 0;
}

void MarginPairs::launch(cl::Kernel& kernel, std::size_t items, std::int64_t moved_bytes,
                         Queue& queue)
{
    if (form_ == KernelForm::groups)
        queue.launch(kernel,
                     (items + margin_group_size - 1) / margin_group_size * margin_group_size,
                     margin_group_size, moved_bytes);
    else
        queue.launch(kernel, chunks_, 1, moved_bytes);
}

bool MarginPairs::still_serves(const Input& input, Queue& queue)
{
    queue.begin("margin");
    queue.clear(outside_.cl(), outside_.bytes());
    set_arguments(check_, input.device_points, low_, high_, static_cast<uint>(low_.size()),
                  outside_);
    launch(check_, low_.size(), static_cast<std::int64_t>(3 * low_.bytes()), queue);
    uint outside = 0;
    queue.read(outside_.cl(), outside_.bytes(), &outside);
    return outside == 0;
}

Input MarginPairs::with_room(const Input& input, Queue& queue)
{
    queue.begin("margin");
    set_arguments(give_, before_, input.device_points, frames_, slack, skin_, low_, high_,
                  static_cast<uint>(low_.size()));
    launch(give_, low_.size(), static_cast<std::int64_t>(4 * low_.bytes()), queue);
    return input.between(low_, high_);
}

void MarginPairs::filter(const DevicePairs& listed, std::size_t most, const Input& input,
                         Queue& queue)
{
    bounds_.enqueue(input, queue, "filter");
    queue.clear(counters_.cl(), counters_.bytes());
    static_assert(PAIRS_COUNT == 0, "the number of pairs is the first count");
    const cl_uint next = set_arguments_from(filter_, 0, listed.pairs, listed.counters,
                                            static_cast<uint>(listed.pairs.size()), bounds_.boxes(),
                                            pairs_, static_cast<uint>(pairs_.size()), counters_);
    if (form_ == KernelForm::chunks)
        set_arguments_from(filter_, next, blocks_);
    launch(filter_, (most + pairs_each - 1) / pairs_each,
           static_cast<std::int64_t>(most * sizeof(Pair)), queue);
}

bool MarginPairs::complete(const Queue& queue)
{
    const bool fits = had_room(pair_room_, count(queue), count(queue) / 8, sizeof(Pair),
                               programs_.device(), "pairs");
    if (!fits)
        take_pairs();
    return fits;
}

std::uint64_t MarginPairs::count(const Queue& queue) const
{
    return wide_counts(counters_, queue).front();
}

std::vector<Pair> MarginPairs::pairs(const Queue& queue) const
{
    return first_entries(pairs_, count(queue), queue, "the pairs found");
}

}  // namespace bvhbench
