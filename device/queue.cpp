// SPDX-License-Identifier: MIT
#include "device/queue.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <limits>
#include <utility>

namespace bvhbench {

namespace {

/// Returns to - from, or 0 if that is negative or `from` is unset: some drivers use another clock or set no time.
std::int64_t between(cl_ulong from, cl_ulong to)
{
    return from > 0 && to > from ? static_cast<std::int64_t>(to - from) : 0;
}

/// Returns the longest time on the device's clock that `wall_ns` on the host's allow: their rates may differ by 2 %.
std::int64_t most_within(std::int64_t wall_ns, std::int64_t resolution_ns)
{
    constexpr std::int64_t reading_ns = 10'000;
    return wall_ns + wall_ns / 50 + 2 * resolution_ns + reading_ns;
}

using Clock = std::chrono::steady_clock;

std::int64_t since(Clock::time_point start)
{
    return std::chrono::nanoseconds(Clock::now() - start).count();
}

}  // namespace

Queue::Queue(const Device& device)
    : queue_(device.context, device.cl, cl::QueueProperties::Profiling)
    , by_host_(device.host_clock)
    , resolution_ns_(
          static_cast<std::int64_t>(device.cl.getInfo<CL_DEVICE_PROFILING_TIMER_RESOLUTION>()))
{}

Queue::Queue(const Device& device, cl::CommandQueue shared)
    : queue_(std::move(shared))
    , resolution_ns_(
          static_cast<std::int64_t>(device.cl.getInfo<CL_DEVICE_PROFILING_TIMER_RESOLUTION>()))
{
    const auto properties = queue_.getInfo<CL_QUEUE_PROPERTIES>();
    has_times_ = (properties & CL_QUEUE_PROFILING_ENABLE) != 0 && !device.host_clock;
    is_in_order_ = (properties & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE) == 0;
}

void Queue::join()
{
    if (!is_in_order_)
        queue_.enqueueBarrierWithWaitList();
}

void Queue::run_after(const Queue& other)
{
    std::vector<cl::Event> reached(1);
    other.queue_.enqueueMarkerWithWaitList(nullptr, &reached.front());
    other.queue_.flush();
    queue_.enqueueBarrierWithWaitList(&reached);
}

void Queue::forget()
{
    launches_.clear();
    stages_.clear();
    begun_.reset();
    stage_begun_.reset();
    added_wall_ns_ = 0;
}

void Queue::begin(std::string_view stage)
{
    end_stage();
    stages_.emplace_back();
    stages_.back().stage = stage;
    stage_begun_ = Clock::now();
    if (!begun_)
        begun_ = stage_begun_;
}

/// Waits for the last stage and times it, if the host's clock is taken.
void Queue::end_stage()
{
    if (!by_host_)
        return;
    queue_.finish();
    if (stage_begun_ && stages_.back().launches > 0) {
        StageTime& stage = stages_.back();
        stage.span_ns = stage.busy_ns = since(*stage_begun_);
        stage.start_ns = std::chrono::nanoseconds(*stage_begun_ - *begun_).count();
    }
    stage_begun_.reset();
}

void Queue::add(std::vector<StageTime> stages, std::int64_t wall_ns)
{
    end_stage();
    std::int64_t end = 0;
    for (const StageTime& time : stages_)
        end = std::max(end, time.start_ns + time.span_ns);
    for (StageTime& time : stages) {
        time.start_ns += time.launches > 0 ? end : 0;
        stages_.push_back(std::move(time));
    }
    added_wall_ns_ += wall_ns;
}

void Queue::declare(std::int64_t moved_bytes) { stages_.back().moved_bytes += moved_bytes; }

/// Records a command of the current stage. Returns where to store its event, or null without times.
cl::Event* Queue::record(std::int64_t moved_bytes)
{
    assert(!stages_.empty() && "name the stage before its first launch");
    ++stages_.back().launches;
    stages_.back().moved_bytes += moved_bytes;
    return has_times_ && !by_host_ ? &launches_.emplace_back(Launch{stages_.size() - 1, {}}).event
                                   : nullptr;
}

void Queue::launch(const cl::Kernel& kernel, std::size_t global, std::size_t local,
                   std::int64_t moved_bytes)
{
    queue_.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(global), cl::NDRange(local),
                                nullptr, record(moved_bytes));
    join();
}

void Queue::clear(const cl::Buffer& memory, std::size_t bytes)
{
    queue_.enqueueFillBuffer(memory, cl_uint{0}, 0, bytes, nullptr,
                             record(static_cast<std::int64_t>(bytes)));
    join();
}

void Queue::copy(const cl::Buffer& from, const cl::Buffer& to, std::size_t first, std::size_t bytes)
{
    if (bytes == 0)
        return;
    queue_.enqueueCopyBuffer(from, to, 0, first, bytes, nullptr,
                             record(2 * static_cast<std::int64_t>(bytes)));
    join();
}

void Queue::read(const cl::Buffer& memory, std::size_t bytes, void* to)
{
    queue_.enqueueReadBuffer(memory, CL_TRUE, 0, bytes, to, nullptr,
                             record(static_cast<std::int64_t>(bytes)));
    join();
}

void Queue::on_host(std::string_view stage, const std::function<void()>& work)
{
    begin(stage);
    work_on_host(work);
}

void Queue::work_on_host(const std::function<void()>& work)
{
    assert(!stages_.empty() && stages_.back().launches == 0);
    queue_.finish();
    const auto start = Clock::now();
    work();
    stages_.back().wall_ns += since(start);
}

std::vector<StageTime> Queue::finish()
{
    end_stage();
    queue_.finish();
    wall_ns_ = std::exchange(added_wall_ns_, 0);
    if (begun_)
        wall_ns_ += since(*begun_);
    begun_.reset();
    try {
        read_times();
    } catch (const BadClock& fault) {
        fault_.emplace(fault);
        for (StageTime& stage : stages_)
            stage = {.stage = std::move(stage.stage),
                     .launches = stage.launches,
                     .moved_bytes = stage.moved_bytes};
    }
    launches_.clear();
    return std::exchange(stages_, {});
}

void Queue::check_times()
{
    if (const std::optional<BadClock> fault = std::exchange(fault_, {}))
        throw *fault;
}

/// Sets the times of the stages from their launches' events. Throws BadClock if these or the host's cannot be true.
void Queue::read_times()
{
    if (wall_ns_ < 0 || std::ranges::any_of(stages_, [](const StageTime& stage) {
            return std::min({stage.wall_ns, stage.span_ns, stage.start_ns}) < 0;
        }))
        throw BadClock(false, "the host's clock went back");
    constexpr auto unset = std::numeric_limits<cl_ulong>::max();
    const auto resolution = static_cast<cl_ulong>(resolution_ns_);
    std::vector<cl_ulong> first(stages_.size(), unset);
    std::vector<cl_ulong> last(stages_.size(), 0);
    cl_ulong begin = unset, last_start = 0, last_end = 0;
    for (const Launch& launch : launches_) {
        const auto start = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
        const auto end = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
        const auto queued = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_QUEUED>();
        const auto submitted = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_SUBMIT>();
        if (start == 0 || end < start)
            throw BadClock(true,
                           "on the device's clock a launch began at 0 or ended before it began");
        if (start + resolution < last_start || end + resolution < last_end)
            throw BadClock(true,
                           "on the device's clock a launch ran before the one that it follows");
        last_start = start;
        last_end = std::max(last_end, end);
        begin = std::min(begin, start);
        StageTime& stage = stages_[launch.stage];
        stage.busy_ns += static_cast<std::int64_t>(end - start);
        stage.queued_ns += between(queued, submitted);
        stage.submitted_ns += between(submitted, start);
        first[launch.stage] = std::min(first[launch.stage], start);
        last[launch.stage] = std::max(last[launch.stage], end);
    }
    if (begin != unset &&
        last_end - begin > static_cast<cl_ulong>(most_within(wall_ns_, resolution_ns_)))
        throw BadClock(true, "on the device's clock launches took longer than on the host's");
    for (std::size_t i = 0; i < stages_.size(); ++i)
        if (first[i] != unset) {
            stages_[i].start_ns = static_cast<std::int64_t>(first[i] - begin);
            stages_[i].span_ns = static_cast<std::int64_t>(last[i] - first[i]);
        }
}

}  // namespace bvhbench
