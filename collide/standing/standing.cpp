// SPDX-License-Identifier: MIT
#include "collide/standing/standing.h"

#include "builders/device_tree.h"
#include "collide/counters.h"
#include "collide/device_lists.h"
#include "collide/parameters.h"

namespace bvhbench {
namespace {

constexpr auto standing_path = "collide/standing/standing.cl";
constexpr uint standing_group_size = 64, standing_block = 512;

/// Pairs that a work-item of the group form looks at: as many as its group has room for each.
constexpr uint standing_each = 8;

}  // namespace

StandingContacts::StandingContacts(Programs& programs, KernelForm form)
    : programs_(programs)
    , form_(chosen_form(programs.device(), form))
    , chunks_(chunk_count(programs.device()))
{
    const std::vector<Define> defines =
        form_ == KernelForm::groups ? std::vector<Define>{{"GROUP_SIZE", standing_group_size},
                                                          {"PAIRS_EACH", standing_each}}
                                    : std::vector<Define>{{"SINK_BLOCK", standing_block}};
    mark_ = programs.kernel(standing_path, "mark_moved", defines);
    copy_ = programs.kernel(standing_path, "copy_those", defines);
}

void StandingContacts::begin(const Input& input, const std::optional<DevicePairs>& contacts,
                             std::size_t room, Queue& queue)
{
    kept_count_ = contacts ? wide_counts(contacts->counters, queue).front() : 0;
    stand_ = contacts && kept_count_ <= room;
    if (!stand_)
        return;
    if (moving_.pairs.size() != room) {
        moving_ = kept_ = {};
        take_memory(arena_, programs_.device(), [&](Arena& arena) {
            moved_ = arena.take<std::uint8_t>(input.triangle_count(), Use::scratch);
            blocks_ = arena.take<Pair>(form_ == KernelForm::groups ? 1 : standing_block * chunks_,
                                       Use::scratch);
            for (DevicePairs* list : {&moving_, &kept_}) {
                list->pairs = arena.take<Pair>(room, Use::scratch);
                list->counters = arena.take<uint>(2, Use::scratch);
            }
        });
    }
    if (kept_count_ == 0)
        return;
    queue.begin("margin");
    queue.copy(contacts->counters.cl(), kept_.counters.cl(), 0, kept_.counters.bytes());
    queue.copy(contacts->pairs.cl(), kept_.pairs.cl(), 0, kept_count_ * sizeof(Pair));
    queue.finish();
}

void StandingContacts::launch(cl::Kernel& kernel, std::size_t items, std::int64_t moved_bytes,
                              Queue& queue)
{
    constexpr std::size_t size = standing_group_size;
    if (form_ == KernelForm::groups)
        queue.launch(kernel, (items + size - 1) / size * size, size, moved_bytes);
    else
        queue.launch(kernel, chunks_, 1, moved_bytes);
}

/// Copies the pairs that stand, or those that do not, to the end of a list.
void StandingContacts::copy_those(bool standing, const DevicePairs& from, std::size_t most,
                                  std::int64_t moved_bytes, const DevicePairs& to, Queue& queue)
{
    static_assert(PAIRS_COUNT == 0, "a list has the number of its pairs first");
    const cl_uint next = set_arguments_from(
        copy_, 0, from.pairs, from.counters, static_cast<uint>(from.pairs.size()), moved_,
        standing ? 1u : 0u, to.pairs, static_cast<uint>(to.pairs.size()), to.counters);
    if (form_ == KernelForm::chunks)
        set_arguments_from(copy_, next, blocks_);
    launch(copy_, (most + standing_each - 1) / standing_each, moved_bytes, queue);
}

void StandingContacts::pick(const DevicePairs& found, std::size_t most, const Buffer<Point>& before,
                            const Input& input, Queue& queue)
{
    stand_ = stand_ && found.pairs.size() <= moving_.pairs.size();
    if (!stand_)
        return;
    const auto count = static_cast<uint>(moved_.size());
    set_arguments(mark_, before, input.device_points, input.device_faces, moved_, count);
    launch(mark_, count, static_cast<std::int64_t>(2 * before.bytes() + count * (sizeof(Face) + 1)),
           queue);
    queue.clear(moving_.counters.cl(), moving_.counters.bytes());
    copy_those(false, found, most, 0, moving_, queue);  // how many are found is not known
}

void StandingContacts::append_to(const DevicePairs& contacts, Queue& queue)
{
    if (stand_ && kept_count_ > 0)
        copy_those(true, kept_, kept_count_, static_cast<std::int64_t>(kept_count_ * sizeof(Pair)),
                   contacts, queue);
}

}  // namespace bvhbench
