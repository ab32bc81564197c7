// SPDX-License-Identifier: MIT
#include "collide/oracles/pair_sets.h"

#include <algorithm>
#include <numeric>
#include <random>

#include "collide/device_lists.h"
#include "geometry/cores.h"

namespace bvhbench {
namespace {

constexpr const char* kernels = "collide/oracles/pair_sets.cl";
constexpr std::size_t items = 1 << 16;  ///< work-items, each with a share of the pairs

/// Boxes side by side, so that a processor holds several at once against another box.
class Part {
public:
    static constexpr std::size_t most = 4096;

    explicit Part(std::span<const Aabb> boxes) : count_(boxes.size())
    {
        for (std::size_t k = 0; k < count_; ++k) {
            const Aabb& box = boxes[k];
            const float mins[] = {box.min_x, box.min_y, box.min_z};
            const float maxs[] = {box.max_x, box.max_y, box.max_z};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                min_[axis][k] = mins[axis];
                max_[axis][k] = maxs[axis];
            }
        }
    }

    /// Calls `found` with the place of each box that has a point in common with `box`.
    template <class FoundBox>
    void for_overlapping(const Aabb& box, const FoundBox& found)
    {
        for (std::size_t k = 0; k < count_; ++k)
            hits_[k] = (min_[0][k] <= box.max_x) & (max_[0][k] >= box.min_x) &
                       (min_[1][k] <= box.max_y) & (max_[1][k] >= box.min_y) &
                       (min_[2][k] <= box.max_z) & (max_[2][k] >= box.min_z);
        const char *const begin = hits_, *const end = hits_ + count_;
        for (const char* hit = std::find(begin, end, 1); hit != end;
             hit = std::find(hit + 1, end, 1))
            found(static_cast<std::size_t>(hit - hits_));
    }

private:
    std::size_t count_;
    float min_[3][most], max_[3][most];
    char hits_[most];
};

cl::Kernel pair_kernel(Programs& programs, const char* name, const Buffer<uint>* names)
{
    const Define defines[] = {{"NAMED", names != nullptr ? 1u : 0u}};
    return programs.kernel(kernels, name, defines);
}

}  // namespace

PairFacts facts_on_device(Programs& programs, const DevicePairs& pairs, std::uint64_t count,
                          Queue& queue, const Buffer<uint>* names)
{
    cl::Kernel kernel = pair_kernel(programs, "hash_pairs", names);
    std::optional<Arena> arena;
    Buffer<SetHash> hashes;
    take_memory(arena, programs.device(),
                [&](Arena& memory) { hashes = memory.take<SetHash>(items, Use::scratch); });
    // A processor reads neighbours fastest, a GPU's lanes what is side by side.
    const std::uint64_t run = programs.device().is_cpu() ? (count + items - 1) / items : 0;
    set_arguments(kernel, pairs.pairs, static_cast<uint>(count), static_cast<uint>(run), hashes);
    if (names != nullptr)
        kernel.setArg(4, names->cl());
    queue.cl().enqueueNDRangeKernel(kernel, cl::NullRange, items);
    const std::vector<SetHash> parts = hashes.download(queue.cl());
    const SetHash all = std::accumulate(parts.begin(), parts.end(), SetHash{0, 0}, both_sets);
    return {count, all.low, all.high};
}

TriangleSample::TriangleSample(std::size_t triangles, std::size_t size)
    : bits_((triangles + 31) / 32, 0)
{
    size = std::min(size, triangles);
    std::mt19937_64 random(triangles);
    while (ids_.size() < size) {
        const auto id = static_cast<uint>(random() % triangles);
        if (has(id))
            continue;
        ids_.push_back(id);
        bits_[id / 32] |= 1u << id % 32;
    }
    std::ranges::sort(ids_);
}

std::vector<Pair> TriangleSample::of_device(Programs& programs, const DevicePairs& pairs,
                                            std::uint64_t count, Queue& queue,
                                            const Buffer<uint>* names) const
{
    cl::Kernel kernel = pair_kernel(programs, "pairs_of_sample", names);
    if (names != nullptr)
        kernel.setArg(6, names->cl());
    std::size_t room = 0;
    for (;;) {  // once to count, once to list
        std::optional<Arena> arena;
        Buffer<uint> sample, found_count;
        Buffer<Pair> found;
        take_memory(arena, programs.device(), [&](Arena& memory) {
            sample = memory.take<uint>(bits_.size(), Use::scratch);
            found_count = memory.take<uint>(1, Use::scratch);
            found = memory.take<Pair>(std::max<std::size_t>(room, 1), Use::scratch);
        });
        sample.upload(queue.cl(), bits_);
        found_count.upload(queue.cl(), std::vector<uint>{0});
        set_arguments(kernel, pairs.pairs, static_cast<uint>(count), sample, found,
                      static_cast<uint>(room), found_count);
        queue.cl().enqueueNDRangeKernel(kernel, cl::NullRange, items);
        const std::size_t there = found_count.download(queue.cl()).front();
        if (there <= room)
            return first_entries(found, there, queue, "the pairs of a sample");
        room = there;
    }
}

PairList TriangleSample::by_brute_force(std::span<const Aabb> boxes,
                                        const WantedPairs& wanted) const
{
    std::vector<std::vector<Pair>> found((boxes.size() + Part::most - 1) / Part::most);
    on_all_cores(found.size(), [&](std::size_t k) {
        const std::size_t first = k * Part::most;
        Part part(boxes.subspan(first, std::min(Part::most, boxes.size() - first)));
        for (const uint id : ids_)
            part.for_overlapping(boxes[id], [&](std::size_t place) {
                const uint other = static_cast<uint>(first + place);
                const bool is_first = !has(other) || id < other;  // of two in the sample
                if (id != other && is_first && wanted(id, other))
                    found[k].push_back({id, other});
            });
    });
    std::vector<Pair> all;
    for (const std::vector<Pair>& some : found)
        all.insert(all.end(), some.begin(), some.end());
    return PairList(std::move(all));
}

}  // namespace bvhbench
