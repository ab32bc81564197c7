// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "builders/input.h"
#include "geometry/moving_query.h"
#include "plugins/process.h"

namespace bvhbench::outside {

/// Which pairs of a mesh are sought, as in bvhbench_mesh.
struct Sought {
    std::size_t first = 0;
    bool drops_adjacent = false;
};

/// One method from outside, at work in a process of its own, which is started for each mesh. All functions throw Unavailable, with a
/// sentence, if it fails.
class State {
public:
    State(const Library& library, const Method& method, const Limits& limits)
        : library_(library), method_(method), limits_(limits)
    {}

    /// Gives the process this frame or step, unless it has it: its mesh by `prepare`, its points by `load`. Returns whether it is a new
    /// one. What is sought is the same until reset(). Not timed.
    bool send_frame(const Input& input, const Sought& sought = {});

    /// Starts the process and gives it queries, all of a vertex and a face or all of two edges. Not timed.
    void send_queries(std::span<const MovingQuery> queries);

    /// Gives it pairs of the frame's triangles to test. Not timed.
    void send_candidates(std::span<const Pair> pairs);

    /// Runs `build`, `refit`, `query`, `answer` or `narrow`, a query `within` a distance if there is one, and adds its stages and the time of the call to the queue. After a pause, in which others are
    /// sampled, allocations of a library take up to twice as long as in a loop of its own: a short build runs once before, untimed.
    void run(std::string_view call, Queue& queue, std::optional<double> within = {});

    /// Results of the last calls. Not timed.
    std::vector<Pair> pairs();
    HostTree tree();
    std::vector<double> times();

    /// Returns the bytes that it says it holds; 0 before the first frame. Throws if they are more than allowed.
    std::uint64_t bytes();

    /// Returns the least time, in nanoseconds, of a request that does nothing: what each call costs beside its work.
    std::int64_t round_trip_ns() const { return round_trip_ns_; }

    /// Ends the process.
    void reset() { process_.reset(); }

private:
    void start();
    void measure_round_trip();
    void take_mesh(const Input& input, const Sought& sought);

    const Library& library_;
    const Method& method_;
    Limits limits_;
    std::unique_ptr<Process> process_;
    std::vector<Face> faces_;        ///< of the process's mesh
    std::vector<Point> points_;      ///< of its frame; empty: none
    std::vector<Point> end_points_;  ///< of its step; empty: it has a frame
    std::size_t queries_ = 0;        ///< number of its queries of moving points
    std::int64_t round_trip_ns_ = 0;
    std::int64_t last_build_ns_ =
        INT64_MAX;  ///< the first build, which compiles, has none before it
};

}  // namespace bvhbench::outside
