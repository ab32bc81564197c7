// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "device/device.h"
#include "geometry/error.h"

namespace bvhbench {

/// Times and traffic of one stage of a build or a query. All times but `wall_ns` are from the device clock, or from the host's if
/// Device::host_clock is set.
struct StageTime {
    std::string stage;
    std::int64_t busy_ns = 0;       ///< sum of the launches' run times
    std::int64_t span_ns = 0;       ///< first start to last end, gaps between launches included
    std::int64_t wall_ns = 0;       ///< host clock; 0 except for stages on the host
    int launches = 0;               ///< number of launches
    std::int64_t moved_bytes = 0;   ///< declared minimum of bytes that the launches read and write
    std::int64_t start_ns = 0;      ///< first start, relative to that of the first stage
    std::int64_t queued_ns = 0;     ///< sum of the launches' times from queued to submitted
    std::int64_t submitted_ns = 0;  ///< sum of the launches' times from submitted to started

    /// Returns the duration to report: the span on the device or, for a host stage, the wall time.
    std::int64_t elapsed_ns() const { return launches > 0 ? span_ns : wall_ns; }
};

/// Times that the device's clock, or the host's, tells cannot be true.
class BadClock : public Unavailable {
public:
    BadClock(bool is_device, const std::string& what) : Unavailable(what), of_device(is_device) {}
    bool of_device;
};

/// A command queue that runs its commands in order and records them by stage. Builders name stages and launch kernels; they
/// never handle events or clocks.
class Queue {
public:
    explicit Queue(const Device& device);

    /// Shares the caller's queue `shared` of the device. Without profiling there are no times. On an out-of-order queue a
    /// barrier follows each command, so that the commands enqueued here still run in order.
    Queue(const Device& device, cl::CommandQueue shared);

    /// Makes all later commands run after all commands that were enqueued before, by any user of the queue. Enqueues a barrier
    /// on an out-of-order queue and nothing on an in-order one. Does not wait.
    void join();

    /// Makes all later commands run after those that were enqueued in `other` before. Does not wait.
    void run_after(const Queue& other);

    /// True if `finish` has durations; if false, they are 0.
    bool has_times() const { return has_times_; }

    /// Discards the stages recorded since the last `finish`. Does not wait.
    void forget();

    /// Begins a stage. Later launches belong to it.
    void begin(std::string_view stage);

    /// Enqueues one kernel. `moved_bytes` is the minimum that it reads and writes, each input and output counted once.
    void launch(const cl::Kernel& kernel, std::size_t global, std::size_t local,
                std::int64_t moved_bytes);

    /// Adds bytes that the current stage reads and writes but that belong to no single launch.
    void declare(std::int64_t moved_bytes);

    /// Enqueues `bytes` of zeros at the front of `memory`. Timed like a launch.
    void clear(const cl::Buffer& memory, std::size_t bytes);

    /// Enqueues a copy of `bytes` from the front of `from` to byte `first` of `to`. Timed like a launch.
    void copy(const cl::Buffer& from, const cl::Buffer& to, std::size_t first, std::size_t bytes);

    /// Reads `bytes` from the front of `memory` after everything enqueued before. Waits. Timed like a launch.
    void read(const cl::Buffer& memory, std::size_t bytes, void* to);

    /// Waits for the queue and runs `work` as part of the current stage, which must have no launches.
    void work_on_host(const std::function<void()>& work);

    /// Begins the stage `stage`, waits for the queue and runs `work` in it.
    void on_host(std::string_view stage, const std::function<void()>& work);

    /// Adds stages that were measured elsewhere, in a call that took `wall_ns` on the host's clock and has ended. Their starts count
    /// from the end of those that were added before.
    void add(std::vector<StageTime> stages, std::int64_t wall_ns);

    /// Waits for the queue, and returns and discards the stages recorded since the last call. If their times cannot be true, all are
    /// 0, and check_times() throws.
    std::vector<StageTime> finish();

    /// Throws BadClock if times of a finish() since the last call cannot be true. Launches must end no earlier than they begin, run
    /// in order, and take no longer than the host's clock says; and that clock must not go back.
    void check_times();

    /// Returns the time on the host's clock, in nanoseconds, of the stages that the last finish() returned: from the beginning of
    /// the first to the end of finish(), and the calls of those that were added.
    std::int64_t wall_ns() const { return wall_ns_; }

    const cl::CommandQueue& cl() const { return queue_; }

private:
    struct Launch {
        std::size_t stage;
        cl::Event event;
    };
    cl::Event* record(std::int64_t moved_bytes);
    void end_stage();
    void read_times();

    cl::CommandQueue queue_;
    bool has_times_ = true;
    bool is_in_order_ = true;
    bool by_host_ = false;            ///< whether stages are timed by the host's clock
    std::int64_t resolution_ns_ = 0;  ///< of the device's clock
    std::optional<BadClock> fault_;
    std::vector<StageTime> stages_;
    std::vector<Launch> launches_;
    std::optional<std::chrono::steady_clock::time_point> begun_;  ///< when the first stage began
    std::optional<std::chrono::steady_clock::time_point>
        stage_begun_;  ///< when the last stage began, unless it has ended
    std::int64_t added_wall_ns_ = 0, wall_ns_ = 0;
};

}  // namespace bvhbench
