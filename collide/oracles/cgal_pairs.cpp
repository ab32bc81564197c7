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

/// Parts of a list of pairs: each has the pairs whose smaller ids are in one range of about equal length. The places of a bin stay
/// in a processor's cache while it is sorted, and pairs are written to it several at a time, since places far apart in memory are
/// slow to write one by one.
class Bins {
public:
    /// The pairs of the smaller id k end at `ends[k]`.
    Bins(std::span<Pair> all, std::span<const std::uint64_t> ends)
        : all_(all), ends_(ends), ids_(std::max<std::size_t>((ends.size() + most - 1) / most, 1))
    {
        for (std::size_t id = 0; id < ends.size(); id += ids_)
            next_.push_back(begin_of(id));
    }

    std::size_t count() const { return next_.size(); }

    /// Writes pairs of one thread, all of them by the end of its life.
    class Writer {
    public:
        explicit Writer(Bins& bins)
            : bins_(bins), waiting_(bins.count() * line), counts_(bins.count())
        {}
        ~Writer()
        {
            for (std::size_t bin = 0; bin < counts_.size(); ++bin)
                flush(bin);
        }
        Writer(const Writer&) = delete;
        Writer& operator=(const Writer&) = delete;

        void put(Pair pair)
        {
            const std::size_t bin = pair.a / bins_.ids_;
            waiting_[bin * line + counts_[bin]] = pair;
            if (++counts_[bin] == line)
                flush(bin);
        }

    private:
        static constexpr std::size_t line = 32;  ///< pairs written at once

        void flush(std::size_t bin)
        {
            const std::uint64_t place = std::atomic_ref(bins_.next_[bin])
                                            .fetch_add(counts_[bin], std::memory_order_relaxed);
            std::copy_n(waiting_.data() + bin * line, counts_[bin], bins_.all_.data() + place);
            counts_[bin] = 0;
        }

        Bins& bins_;
        std::vector<Pair> waiting_;  ///< `line` of each bin
        std::vector<std::size_t> counts_;
    };

    /// Sorts a bin that is full: into the pairs of each smaller id, and those by the larger one.
    void sort(std::size_t bin)
    {
        const std::size_t first = bin * ids_, last = std::min(first + ids_, ends_.size());
        const std::span<Pair> own = all_.subspan(begin_of(first), begin_of(last) - begin_of(first));
        const std::vector<Pair> unsorted(own.begin(), own.end());
        std::vector<std::uint64_t> next(last - first);
        for (std::size_t id = first; id < last; ++id)
            next[id - first] = begin_of(id);
        for (const Pair pair : unsorted)
            all_[next[pair.a - first]++] = pair;
        for (std::size_t id = first; id < last; ++id)
            std::sort(all_.data() + begin_of(id), all_.data() + begin_of(id + 1));
    }

private:
    static constexpr std::size_t most = 1024;

    std::uint64_t begin_of(std::size_t id) const { return id == 0 ? 0 : ends_[id - 1]; }

    std::span<Pair> all_;
    std::span<const std::uint64_t> ends_;
    std::size_t ids_;                  ///< smaller ids of a bin
    std::vector<std::uint64_t> next_;  ///< where the next pair of each bin is written
};

}  // namespace

PairList pairs_of_cgal(std::span<const Aabb> boxes, const WantedPairs& wanted)
{
    require_host_memory("checking the pairs", boxes.size() * sizeof(PlacedBox));
    require_host_memory("checking the pairs", 2 * boxes.size() * sizeof(std::uint64_t));
    const Slabs slabs(boxes);
    std::vector<std::uint64_t> ends(boxes.size(),
                                    0);  // of the pairs of each smaller id; first counts
    on_all_cores(slabs.count(), [&](std::size_t slab) {
        slabs.for_pairs(slab, [&](uint a, uint b) {
            if (wanted(a, b))
                std::atomic_ref(ends[std::min(a, b)]).fetch_add(1, std::memory_order_relaxed);
        });
    });
    const std::uint64_t count = std::reduce(ends.begin(), ends.end(), std::uint64_t{0});
    require_host_memory("checking the pairs, " + std::to_string(count) + " of them,",
                        count * sizeof(Pair));
    std::inclusive_scan(ends.begin(), ends.end(), ends.begin());
    std::vector<Pair> all(count);
    Bins bins(all, ends);
    on_all_cores(slabs.count(), [&](std::size_t slab) {
        Bins::Writer writer(bins);
        slabs.for_pairs(slab, [&](uint a, uint b) {
            if (wanted(a, b))
                writer.put({std::min(a, b), std::max(a, b)});
        });
    });
    on_all_cores(bins.count(), [&](std::size_t bin) { bins.sort(bin); });
    return PairList(std::move(all));
}

}  // namespace bvhbench
