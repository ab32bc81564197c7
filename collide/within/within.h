// SPDX-License-Identifier: MIT
//
// Pairs of triangles within a distance of each other: boxes with half of it to each side, a collider's pairs of these, and a narrow phase.
//
//     pad       room around each vertex (pad.cl)     ->  any builder and collider, as over swept boxes
//     narrow    pairs of these boxes, in passes      ->  pairs within the distance, and unsure ones (within.cl, distance_filter.h)
//     exact     unsure pairs, in integers, on host   ->  the others within the distance (exact_distance.h)
//
// On a GPU the passes are: floats and the ways between corners, which show most; floats and all ways; doubles. Each takes what the one before
// left over, so that the lanes of a wave do the same. On a processor there is one, in doubles.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "builders/input.h"
#include "builders/stages/kernel_form.h"
#include "collide/collider.h"
#include "collide/within/padding.h"

namespace bvhbench {

struct WithinOptions {
    /// In the unit of the points. Not negative, and finite.
    double distance = 0;
    /// "none", "exact" or a method for distances. Others than the exact one leave nothing over, and may be wrong.
    std::string_view method = "exact";
    /// True to report pairs that share a vertex index, whose distance is 0; false to leave them out.
    bool keep_adjacent = false;
    KernelForm form = KernelForm::of_device;
    /// Initial capacity of the lists of pairs, in pairs; 0: estimated. They grow when too small.
    std::size_t capacity = 0;
    /// True to decide on the host, as on devices without doubles. For tests.
    bool without_doubles = false;
};

/// Results of a query. Pairs that share an index are decided by that.
struct WithinCounts {
    std::uint64_t within = 0;
    std::uint64_t exactly = 0;  ///< candidates left to exact arithmetic
};

/// Finds the candidates whose triangles are at most a distance apart, exactly for the coordinates as stored and for the distance, a double.
/// Triangles are closed sets, and one without area is the segment or point that it degenerates to: two that touch or intersect have
/// distance 0. No pair is dropped silently: a query is repeated until it is `complete`.
class WithinPhase {
public:
    /// Throws BadUsage for a distance that is negative or not finite, and for a method that is not for distances; Unavailable for one that
    /// needs doubles, on a device without.
    WithinPhase(Programs& programs, const WithinOptions& options);

    /// Changes the distance of the queries from here on. Throws BadUsage as the constructor.
    void set_distance(double distance);

    /// Reserves memory to pad `points`, and for the pairs of `triangles`. Never timed. Throws Unavailable.
    void reserve(std::size_t points, std::size_t triangles);

    /// Memory reserved at present.
    Footprint reserved() const;

    /// Gives each vertex its room, as Padding::padded: boxes of triangles within the distance overlap. Does not block.
    Input padded(const Input& input, Queue& queue)
    {
        return padding_.padded(input, reach_of(options_.distance), queue);
    }

    /// Enqueues the stages `narrow` and `exact` over pairs of padded boxes, in any order. Candidates beyond their list are not tested, so
    /// complete the broad phase first. Reads the device's points and faces if the host has none. Blocks.
    void query(const Input& input, const DevicePairs& candidates, Queue& queue);

    /// True if every list of the last query was large enough; otherwise enlarges them. Blocks.
    bool complete(const Queue& queue);

    /// Counts and pairs of the last query, which must have been complete. Both functions block.
    WithinCounts counts(const Queue& queue) const;
    std::vector<Pair> pairs(const Queue& queue) const;

    /// By how much the distances computed by a method in floats or doubles are off, as shares of the distance asked for, sorted. Empty for
    /// other methods and for a distance of 0. `input` has the host's points. Blocks.
    std::vector<double> distance_errors(const Input& input, const Queue& queue) const;

    /// The same pairs in device memory; their number is at CONTACTS_COUNT of the counters.
    DevicePairs device_pairs() const { return {pairs_, counters_}; }

private:
    /// A launch over the pairs that the one before left over, the first over all candidates.
    struct Pass {
        cl::Kernel kernel;
        unsigned real_bits;
        uint left_at;  ///< where the counters have the number of pairs left over
        std::size_t room = 0;
        Buffer<Pair> left = {};
    };

    bool in_groups() const { return form_ == KernelForm::groups; }
    void add_pass(unsigned test, unsigned real_bits, uint from, uint left_at);
    void take_lists();
    void decide_on_host(const Input& input, const DevicePairs& candidates, const Queue& queue);

    Programs& programs_;
    WithinOptions options_;
    KernelForm form_;
    Padding padding_;
    bool is_exact_ = true, computes_distances_ = false;
    double low_ = 0, high_ = 0;  ///< around the square of the distance
    std::vector<Pass> passes_;
    std::size_t room_ = 0;
    std::optional<Arena> arena_, lists_;
    Buffer<Pair> pairs_;
    Buffer<double> distances_;
    Buffer<uint> counters_;
};

/// True if two triangles are within the distance, by the host's arithmetic alone.
bool are_within(std::span<const Point> points, std::span<const Face> faces, Pair pair,
                const WithinOptions& options);

}  // namespace bvhbench
