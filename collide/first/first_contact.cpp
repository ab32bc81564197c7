// SPDX-License-Identifier: MIT
#include "collide/first_contact.h"

#include <algorithm>

#include "collide/counters.h"
#include "collide/device_lists.h"
#include "collide/host_triangles.h"
#include "collide/narrow/narrow.h"

namespace bvhbench {
namespace {

constexpr std::size_t groups_per_unit = 2;  // as of narrow_exact.cl

}  // namespace

FirstContact::FirstContact(Programs& programs, const ColliderOptions& options, uint group_size,
                           std::size_t room)
    : device_(programs.device())
    , has_doubles_(has_doubles(device_) && !options.without_doubles)
    , keeps_adjacent_(options.keep_adjacent)
    , room_(room)
    , items_(chunk_count(device_))
{
    if (chosen_form(device_, options.form) == KernelForm::groups) {
        group_size_ = group_size;
        items_ = group_size_ * groups_per_unit * device_.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    }
    if (has_doubles_)
        decide_ = programs.kernel("collide/first/decide.cl", "decide_first",
                                  {{"KEEP_ADJACENT", keeps_adjacent_ ? 1u : 0u}});
}

void FirstContact::decide(const Input& input, Buffer<Pair>& pairs, Buffer<uint>& counters,
                          Queue& queue)
{
    if (!has_doubles_) {
        decide_on_host(input, pairs, counters, queue);
        return;
    }
    set_arguments(decide_, input.device_points, input.device_faces, unsure_, room(), pairs,
                  counters);
    queue.launch(decide_, items_, group_size_, 0);
}

/// As decide.cl.
void FirstContact::decide_on_host(const Input& input, Buffer<Pair>& pairs, Buffer<uint>& counters,
                                  const Queue& queue) const
{
    std::vector<uint> words = counters.download(queue.cl());
    if (words[PAIRS_COUNT] == 0 && words[UNSURE_COUNT] > 0) {
        const HostTriangles here(input, queue);
        const std::vector<Pair> unsure = first_entries(
            unsure_, std::min(words[UNSURE_COUNT], room()), queue, "the pairs left to the host");
        const auto found = std::ranges::find_if(unsure, [&](Pair pair) {
            return triangles_meet(here.points, here.faces, pair, keeps_adjacent_);
        });
        if (found != unsure.end()) {
            queue.cl().enqueueWriteBuffer(pairs.cl(), CL_TRUE, 0, sizeof(Pair), &*found);
            words[PAIRS_COUNT] = 1;
        }
    }
    if (words[PAIRS_COUNT] == 0)
        return;
    words[UNSURE_COUNT] = words[UNSURE_COUNT + 1] = 0;
    counters.upload(queue.cl(), words);
}

bool FirstContact::make_room(std::uint64_t count)
{
    return had_room(room_, count, count / 8, sizeof(Pair), device_, "unsure pairs");
}

}  // namespace bvhbench
