// SPDX-License-Identifier: MIT
//
// Queries of moving points without a tree: continuous collision detection alone, by several methods.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"
#include "geometry/moving_query.h"

namespace bvhbench {

/// A method that says when two features may touch first.
struct QueryMethod {
    std::string_view name;
    std::string_view summary;
    unsigned answer;     ///< ANSWER of queries.cl
    unsigned real_bits;  ///< precision of what it computes
    /// Features that come nearer than this share of the largest difference between their vertices along an axis may be taken to touch.
    double tolerance;

    /// True if no touch is missed, and none is said to be later than it is, whatever is rounded.
    constexpr bool misses_none() const { return answer == 1; }

    /// True if features may be kept a separation apart. Roots are of a volume, which is 0 where they touch.
    constexpr bool can_separate() const { return answer != 3; }
};

/// All methods, in the order of tables.
std::span<const QueryMethod> query_methods();

/// A time after the step: the features do not touch.
constexpr double no_impact = 2;

/// Answers queries that are all of a vertex and a face or all of two edges.
class ImpactQueries {
public:
    /// Throws Unavailable if the device has no doubles, which all coordinates are, and BadUsage for a separation that is no length, or
    /// that the method cannot keep.
    ImpactQueries(Programs& programs, const QueryMethod& method, double separation = 0);

    /// Copies `copies` times all queries to the device, one after the other. Not timed. Waits. Throws Unavailable for more than 2^31
    /// queries in all or too little memory.
    void load(std::span<const MovingQuery> queries, std::size_t copies, const Queue& queue);

    /// Enqueues the stage `narrow` over all that was loaded. Does not wait.
    void query(Queue& queue);

    /// Returns the answers to one copy of the queries, for each a time from 0 to 1, the step, or `no_impact`. Waits.
    std::vector<double> times(const Queue& queue) const;

    /// Returns how many queries of all copies a limit of steps ended. Waits.
    std::uint64_t cut_short(const Queue& queue) const;

private:
    Programs& programs_;
    cl::Kernel kernel_;
    double tolerance_, separation_;
    std::size_t count_ = 0, in_all_ = 0;
    bool of_edges_ = false;
    std::optional<Arena> arena_;
    Buffer<double> from_, to_, times_;
    Buffer<uint> cut_short_;
};

}  // namespace bvhbench
