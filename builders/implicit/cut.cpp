// SPDX-License-Identifier: MIT
#include "builders/implicit/cut.h"

#include <algorithm>
#include <bit>
#include <string>

#include "builders/parameters.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

constexpr uint subtrees_per_core = 32;  ///< into which the first launch of `chunks` cuts a tree

uint most_group_size(const Device& device, uint items, std::size_t box_bytes)
{
    const std::size_t room = device.cl.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>() /
                             local_box_bytes({.group_size = 1, .items = items}, box_bytes);
    return static_cast<uint>(std::bit_floor(std::min<std::size_t>(
        {room, device.cl.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>(), std::size_t{1024}})));
}

/// Returns the cut for groups of g work-items with i nodes each: g * i nodes on the entry level, one on the last.
Cut groups_of(uint group_size, uint items)
{
    return {KernelForm::groups, group_size, items, floor_log2(2 * group_size * items)};
}

/// Returns the cut with the smallest groups among those with the fewest launches. On an H200 (µs, hierarchy from ids): 871,306
/// triangles take 28 with groups of 256 (3 launches), 23 with 512 and 25 with 1024 (2 launches); 2,880,000 take 58 with 256 and
/// 60 with 512 (3 launches), 58 with 1024 (2 launches).
Cut smallest_group_with_fewest_launches(uint leaf_level, uint items, uint most)
{
    Cut best = groups_of(std::min(256u, most), items);
    for (uint size = best.group_size; size <= most; size *= 2)
        if (const Cut cut = groups_of(size, items);
            divided_up(leaf_level, cut.levels) < divided_up(leaf_level, best.levels))
            best = cut;
    return best;
}

/// Returns the cut for `chunks`: many subtrees per core, so that no core waits long for another, but small enough for its
/// cache. On two cores (ms, subtrees of 10, 12, 14, 16 levels): 144,046 triangles 0.26, 0.16, 0.32, 0.41; 1,087,716 3.5, 3.3,
/// 3.3, 3.8.
Cut subtrees_of_items(const Device& device, uint leaf_level)
{
    const uint cores = device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    const uint split = ceil_log2(subtrees_per_core * cores);
    return {KernelForm::chunks, 1, 1,
            std::clamp(leaf_level > split ? leaf_level - split : 0u, 10u, 14u)};
}

/// Returns the cut for a build in one launch, where the number of groups costs little. On an H200 (µs, hierarchy from ids):
/// 144,046 triangles take 11.1 with groups of 256 and 12.3 with groups of 512 and two nodes per work-item; 2,880,000 take 59.8
/// and 56.3. If groups wait, small groups are best, because they free their units soonest. If each group climbs, fewer groups are:
/// 144,046 triangles take 14.5 with groups of 512 and 15.9 with groups of 256.
Cut groups_of_one_launch(Meeting meeting, uint leaf_level, uint items, uint most)
{
    if (meeting == Meeting::by_climbing)
        return groups_of(std::min(512u, most), std::max(1u, items));
    if (meeting == Meeting::by_waiting || leaf_level <= 18 || items != 0)
        return groups_of(std::min(256u, most), std::max(1u, items));
    return groups_of(std::min(512u, most), 2);
}

void require_power_of_two(const char* what, uint value, uint most, const Device& device)
{
    if (!std::has_single_bit(value) || value > most)
        throw BadUsage(std::string(what) + " is a power of two up to " + std::to_string(most) +
                       " on " + device.name() + ", not " + std::to_string(value));
}

}  // namespace

Cut choose_cut(const Device& device, const BuildOptions& options, Meeting meeting, uint leaves,
               std::size_t box_bytes)
{
    const bool is_printed = meeting == Meeting::by_local_atomics;  // a work-item has one node
    const uint items = std::max(1u, options.items);
    require_power_of_two("the number of items a work-item", items, is_printed ? 1 : 8, device);
    const uint most = most_group_size(device, items, box_bytes);
    if (options.group_size != 0) {  // explicit group sizes select the paper's groups, on a CPU too
        require_power_of_two("a group size", options.group_size, most, device);
        return groups_of(options.group_size, items);
    }
    if (device.is_cpu())
        return subtrees_of_items(device, implicit_leaf_level(leaves));
    if (meeting != Meeting::between_launches && !is_printed) {
        const bool climbs = meeting == Meeting::by_climbing;  // has no tuned group size of its own
        if (const uint tuned = climbs ? 0 : device.tuned(implicit_handoff_group_size); tuned != 0)
            return groups_of(std::min(tuned, most), items);
        return groups_of_one_launch(meeting, implicit_leaf_level(leaves), options.items, most);
    }
    if (const uint tuned = is_printed ? 0 : device.tuned(implicit_group_size); tuned != 0)
        return groups_of(std::min(tuned, most), items);
    return smallest_group_with_fewest_launches(implicit_leaf_level(leaves), items, most);
}

Cut cut_that_fits(Cut cut, const std::function<bool(const Cut&)>& fits)
{
    while (cut.group_size > 1 && !fits(cut))
        cut = groups_of(cut.group_size / 2, cut.items);
    return cut;
}

}  // namespace bvhbench
