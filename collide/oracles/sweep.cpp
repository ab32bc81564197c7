// SPDX-License-Identifier: MIT
#include "collide/oracles/sweep.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include "collide/oracles/axes.h"
#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

/// Boxes in strips across the second axis, each swept along the first axis. A box is in every strip that it overlaps.
class Strips {
public:
    explicit Strips(std::span<const Aabb> boxes) : boxes_(boxes), axes_(axes_of(boxes))
    {
        // Strip width: a box overlaps one and a half strips on average.
        const double count = std::min(0.5 / axes_[1].share, static_cast<double>(boxes.size()) / 16);
        count_ = count > 1 ? static_cast<std::size_t>(count) : 1;
        ends_.assign(count_ + 1, 0);
        for (const Aabb& box : boxes_)
            for (std::size_t k = first_of(box); k <= last_of(box); ++k)
                ++ends_[k];
        std::exclusive_scan(ends_.begin(), ends_.end(), ends_.begin(), std::size_t{0});
        ids_.resize(ends_.back());
        for (uint id = 0; id < boxes_.size(); ++id)
            for (std::size_t k = first_of(boxes_[id]); k <= last_of(boxes_[id]); ++k)
                ids_[ends_[k]++] = id;
        const auto begins_first = [&](uint a, uint b) {
            return boxes_[a].*axes_[0].min < boxes_[b].*axes_[0].min;
        };
        for (std::size_t k = 0; k < count_; ++k)
            std::sort(ids_.begin() + begin_of(k), ids_.begin() + end_of(k), begins_first);
    }

    /// Calls `found` once for each pair of boxes that overlap.
    template <class FoundPair>
    void sweep(const FoundPair& found) const
    {
        std::vector<Aabb> swept;  // contiguous copies, in the order in which they are read
        for (std::size_t k = 0; k < count_; ++k) {
            const std::span ids(ids_.begin() + begin_of(k), ids_.begin() + end_of(k));
            swept.clear();
            for (const uint id : ids)
                swept.push_back(boxes_[id]);
            // If two boxes overlap, the one that begins later does so before the other ends.
            for (std::size_t i = 0; i < swept.size(); ++i) {
                const float end = swept[i].*axes_[0].max;
                for (std::size_t j = i + 1; j < swept.size() && swept[j].*axes_[0].min <= end; ++j)
                    if (overlap(swept[i], swept[j]) && is_of(k, swept[i], swept[j]))
                        found(ids[i], ids[j]);
            }
        }
    }

    /// Estimated peak host memory of a sweep of `boxes` boxes, without the pairs, in bytes.
    static std::uint64_t bytes(std::size_t boxes)
    {
        return boxes * (sizeof(Aabb) + 2 * sizeof(uint) + sizeof(uint) / 2);
    }

private:
    std::ptrdiff_t begin_of(std::size_t strip) const
    {
        return static_cast<std::ptrdiff_t>(strip == 0 ? 0 : ends_[strip - 1]);
    }
    std::ptrdiff_t end_of(std::size_t strip) const
    {
        return static_cast<std::ptrdiff_t>(ends_[strip]);
    }

    /// Returns the strip of a coordinate; monotonic. NaN is in the first strip.
    std::size_t strip_of(float place) const
    {
        const double at = (static_cast<double>(place) - axes_[1].low) / axes_[1].length *
                          static_cast<double>(count_);
        return at > 0 ? static_cast<std::size_t>(std::min(at, static_cast<double>(count_ - 1))) : 0;
    }
    std::size_t first_of(const Aabb& box) const { return strip_of(box.*axes_[1].min); }
    std::size_t last_of(const Aabb& box) const { return strip_of(box.*axes_[1].max); }

    /// Two boxes may overlap in several strips. Their pair is reported in the strip in which their intersection begins.
    bool is_of(std::size_t strip, const Aabb& a, const Aabb& b) const
    {
        return count_ == 1 || strip_of(std::max(a.*axes_[1].min, b.*axes_[1].min)) == strip;
    }

    std::span<const Aabb> boxes_;
    std::array<Axis, 3> axes_;
    std::size_t count_ = 1;
    std::vector<std::size_t> ends_;  ///< end of each strip in `ids_`
    std::vector<uint> ids_;
};

}  // namespace

PairList swept_pairs(std::span<const Aabb> boxes, const WantedPairs& wanted)
{
    require_host_memory("checking the pairs", Strips::bytes(boxes.size()));
    const Strips strips(boxes);
    std::uint64_t count = 0;
    strips.sweep([&](uint a, uint b) { count += wanted(a, b) ? 1 : 0; });
    require_host_memory("checking the pairs, " + std::to_string(count) + " of them,",
                        count * sizeof(Pair));
    std::vector<Pair> found;
    found.reserve(count);
    const auto list = [&](uint a, uint b) {
        if (wanted(a, b))
            found.push_back({a, b});
    };
    strips.sweep(list);
    return PairList(std::move(found));
}

}  // namespace bvhbench
