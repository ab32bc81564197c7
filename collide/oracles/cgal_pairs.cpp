// SPDX-License-Identifier: MIT
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <string>
#include <vector>

#include "collide/oracles/axes.h"
#include "collide/oracles/box_pairs.h"
#include "geometry/cores.h"
#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

constexpr std::size_t least_slab = 4096;   ///< boxes that begin in a slab, at least
constexpr std::size_t slabs_per_core = 4;  ///< so that all cores end together

/// Returns the place of a float, which is no NaN, among all floats. -0 is at the place of 0. CGAL takes the largest float for more
/// than any coordinate; as integers, even infinities are in its range.
int place_of(float value)
{
    const int size = static_cast<int>(as_uint(value) & 0x7fffffffu);
    return as_uint(value) >> 31u != 0 ? -size : size;
}

/// A box as CGAL's concept BoxIntersectionBox_d wants it.
struct PlacedBox {
    using NT = int;
    using ID = uint;
    static int dimension() { return 3; }
    int min_coord(int axis) const { return min[axis]; }
    int max_coord(int axis) const { return max[axis]; }
    uint id() const { return number; }

    int min[3], max[3];
    uint number;
};

/// Boxes in the order in which they begin along one axis, cut into slabs of equal numbers. A pair is of the slab in which the later
/// of its boxes begins.
class Slabs {
public:
    explicit Slabs(std::span<const Aabb> boxes)
    {
        boxes_.reserve(boxes.size());
        const std::array<Axis, 3> axes = axes_of(boxes);
        for (uint k = 0; k < boxes.size(); ++k) {
            PlacedBox placed = {{}, {}, k};
            bool is_box = true;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const float min = boxes[k].*axes[axis].min, max = boxes[k].*axes[axis].max;
                is_box &= min <= max;
                placed.min[axis] = place_of(min);
                placed.max[axis] = place_of(max);
            }
            if (is_box)
                boxes_.push_back(placed);
        }
        std::sort(boxes_.begin(), boxes_.end(), [](const PlacedBox& a, const PlacedBox& b) {
            return a.min[across] < b.min[across];
        });
        count_ =
            std::clamp<std::size_t>(boxes_.size() / least_slab, 1, slabs_per_core * core_count());
    }

    std::size_t count() const { return count_; }

    /// Calls `found` once for each pair of a slab.
    template <class FoundPair>
    void for_pairs(std::size_t slab, const FoundPair& found) const
    {
        const auto begin = boxes_.begin() + begin_of(slab),
                   end = boxes_.begin() + begin_of(slab + 1);
        if (begin == end)
            return;
        const auto reaches = [from = begin->min[across]](const PlacedBox& box) {
            return box.max[across] >= from;
        };
        const auto reaching = std::count_if(boxes_.begin(), begin, reaches);
        require_host_memory(
            "checking the pairs",
            static_cast<std::uint64_t>(2 * (end - begin) + reaching) * sizeof(PlacedBox));
        std::vector<PlacedBox> own(begin, end), before;
        before.reserve(static_cast<std::size_t>(reaching));
        std::copy_if(boxes_.begin(), begin, std::back_inserter(before), reaches);
        const auto call = [&found](const PlacedBox& a, const PlacedBox& b) {
            found(a.number, b.number);
        };
        CGAL::box_intersection_d(own.begin(), own.end(), before.begin(), before.end(), call,
                                 cutoff);
        CGAL::box_self_intersection_d(own.begin(), own.end(), call, cutoff);
    }

private:
    static constexpr std::size_t across = 0;       ///< the axis of the slabs, shortest first
    static constexpr std::ptrdiff_t cutoff = 100;  ///< fewer boxes are scanned: time, not results

    std::ptrdiff_t begin_of(std::size_t slab) const
    {
        return static_cast<std::ptrdiff_t>(boxes_.size() * slab / count_);
    }

    std::vector<PlacedBox> boxes_;
    std::size_t count_ = 1;
};

}  // namespace

PairList pairs_of_cgal(std::span<const Aabb> boxes, const WantedPairs& wanted)
{
    require_host_memory("checking the pairs", boxes.size() * sizeof(PlacedBox));
    require_host_memory("checking the pairs", 2 * boxes.size() * sizeof(std::uint64_t));
    const Slabs slabs(boxes);
    // Each pair is written among those of its smaller id, so that only these few have to be sorted.
    const auto next_of = [](std::vector<std::uint64_t>& places, uint a) {
        return std::atomic_ref(places[a]).fetch_add(1, std::memory_order_relaxed);
    };
    std::vector<std::uint64_t> ends(boxes.size(),
                                    0);  // of the pairs of each smaller id; first counts
    on_all_cores(slabs.count(), [&](std::size_t slab) {
        slabs.for_pairs(slab, [&](uint a, uint b) {
            if (wanted(a, b))
                next_of(ends, std::min(a, b));
        });
    });
    const std::uint64_t count = std::reduce(ends.begin(), ends.end(), std::uint64_t{0});
    require_host_memory("checking the pairs, " + std::to_string(count) + " of them,",
                        count * sizeof(Pair));
    std::exclusive_scan(ends.begin(), ends.end(), ends.begin(), std::uint64_t{0});
    const std::vector<std::uint64_t> begins = ends;
    std::vector<Pair> all(count);
    on_all_cores(slabs.count(), [&](std::size_t slab) {
        slabs.for_pairs(slab, [&](uint a, uint b) {
            if (wanted(a, b))
                all[next_of(ends, std::min(a, b))] = {std::min(a, b), std::max(a, b)};
        });
    });
    constexpr std::size_t part = 4096;
    on_all_cores((boxes.size() + part - 1) / part, [&](std::size_t k) {
        for (std::size_t id = k * part; id < std::min(boxes.size(), (k + 1) * part); ++id)
            std::sort(all.data() + begins[id], all.data() + ends[id]);
    });
    return PairList(std::move(all));
}

}  // namespace bvhbench
