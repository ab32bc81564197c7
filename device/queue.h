// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "device/device.h"

namespace bvhbench {

/// What one stage of a build or a query cost. A duration's name says how it was read.
struct StageTime {
    std::string stage;
    std::int64_t busy_ns = 0;  ///< device clock, sum of the kernels' run times
    std::int64_t span_ns =
        0;  ///< device clock, first start to last end: gaps between launches count
    std::int64_t wall_ns = 0;  ///< host clock; set by host stages only
    int launches = 0;
    std::int64_t moved_bytes = 0;  ///< the least its launches must read and write, as they declared
    std::int64_t start_ns = 0;  ///< device clock, its first start, from that of the first stage on
    std::int64_t queued_ns =
        0;  ///< device clock, sum of the launches' times from queued to submitted
    std::int64_t submitted_ns =
        0;  ///< the same from submitted to started; from there on it is busy

    /// The one duration to quote: the span on the device, else the host clock.
    std::int64_t elapsed_ns() const { return launches > 0 ? span_ns : wall_ns; }
};

/// An in-order queue that remembers what it ran and on whose behalf.
///
/// Builders name their stages and launch kernels; they never see an event or a clock.
class Queue {
public:
    explicit Queue(const Device& device);

    /// Somebody else's queue of that device, which stays theirs. Without profiling there are no times. In an out-of-order
    /// queue each command waits for all before it, so that what is enqueued here still runs in order.
    Queue(const Device& device, cl::CommandQueue shared);

    /// What is enqueued from here on runs after all that anybody has enqueued before: of an in-order queue no more than
    /// the truth. Does not wait.
    void join();

    /// Whether `finish` reads the device clock; if not, durations are 0.
    bool has_times() const { return has_times_; }

    /// Forget the stages since the last `finish` without waiting for them.
    void forget();

    /// Launches from here on belong to `stage`.
    void begin(std::string_view stage);

    /// Enqueue one kernel. `moved_bytes` is what it must read and write at least, each input and output once.
    void launch(const cl::Kernel& kernel, std::size_t global, std::size_t local,
                std::int64_t moved_bytes);

    /// Bytes besides, that the launches of the stage begun must read and write, and that are no single launch's.
    void declare(std::int64_t moved_bytes);

    /// Enqueue `bytes` of zeros at the front of `memory`. Timed like a launch.
    void clear(const cl::Buffer& memory, std::size_t bytes);

    /// Enqueue a copy of `bytes` at the front of `from` to `to`, from its byte `first` on. Timed like a launch.
    void copy(const cl::Buffer& from, const cl::Buffer& to, std::size_t first, std::size_t bytes);

    /// Read the front of `memory` once all before has run. Waits. Timed like a launch.
    void read(const cl::Buffer& memory, std::size_t bytes, void* to);

    /// Run host work as part of the stage begun last, which launches nothing, after everything enqueued before has
    /// finished.
    void work_on_host(const std::function<void()>& work);

    /// The same as a stage of its own.
    void on_host(std::string_view stage, const std::function<void()>& work);

    /// Wait for everything, then return and forget the stages since the last call.
    std::vector<StageTime> finish();

    const cl::CommandQueue& cl() const { return queue_; }

private:
    struct Launch {
        std::size_t stage;
        cl::Event event;
    };
    cl::Event* record(std::int64_t moved_bytes);

    cl::CommandQueue queue_;
    bool has_times_ = true;
    bool is_in_order_ = true;
    std::vector<StageTime> stages_;
    std::vector<Launch> launches_;
};

}  // namespace bvhbench
