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

}  // namespace

Queue::Queue(const Device& device)
    : queue_(device.context, device.cl, cl::QueueProperties::Profiling)
{}

Queue::Queue(const Device&, cl::CommandQueue shared) : queue_(std::move(shared))
{
    const auto properties = queue_.getInfo<CL_QUEUE_PROPERTIES>();
    has_times_ = (properties & CL_QUEUE_PROFILING_ENABLE) != 0;
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
    added_wall_ns_ = 0;
}

void Queue::begin(std::string_view stage)
{
    stages_.emplace_back();
    stages_.back().stage = stage;
    if (!begun_)
        begun_ = std::chrono::steady_clock::now();
}

void Queue::add(std::vector<StageTime> stages, std::int64_t wall_ns)
{
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
    return has_times_ ? &launches_.emplace_back(Launch{stages_.size() - 1, {}}).event : nullptr;
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
    using clock = std::chrono::steady_clock;
    assert(!stages_.empty() && stages_.back().launches == 0);
    queue_.finish();
    const auto start = clock::now();
    work();
    stages_.back().wall_ns += std::chrono::nanoseconds(clock::now() - start).count();
}

std::vector<StageTime> Queue::finish()
{
    queue_.finish();
    wall_ns_ = std::exchange(added_wall_ns_, 0);
    if (begun_)
        wall_ns_ += std::chrono::nanoseconds(std::chrono::steady_clock::now() - *begun_).count();
    begun_.reset();
    constexpr auto unset = std::numeric_limits<cl_ulong>::max();
    std::vector<cl_ulong> first(stages_.size(), unset);
    std::vector<cl_ulong> last(stages_.size(), 0);
    for (const Launch& launch : launches_) {
        const auto start = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
        const auto end = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
        const auto queued = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_QUEUED>();
        const auto submitted = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_SUBMIT>();
        StageTime& stage = stages_[launch.stage];
        stage.busy_ns += static_cast<std::int64_t>(end - start);
        stage.queued_ns += between(queued, submitted);
        stage.submitted_ns += between(submitted, start);
        first[launch.stage] = std::min(first[launch.stage], start);
        last[launch.stage] = std::max(last[launch.stage], end);
    }
    const cl_ulong begin = first.empty() ? unset : *std::min_element(first.begin(), first.end());
    for (std::size_t i = 0; i < stages_.size(); ++i)
        if (first[i] != unset) {
            stages_[i].start_ns = static_cast<std::int64_t>(first[i] - begin);
            stages_[i].span_ns = static_cast<std::int64_t>(last[i] - first[i]);
        }
    launches_.clear();
    return std::exchange(stages_, {});
}

}  // namespace bvhbench
