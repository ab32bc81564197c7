// SPDX-License-Identifier: MIT
#include "device/queue.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <limits>
#include <utility>

namespace bvhbench {

Queue::Queue(const Device& device)
    : queue_(device.context, device.cl, cl::QueueProperties::Profiling)
{}

void Queue::begin(std::string_view stage)
{
    stages_.emplace_back();
    stages_.back().stage = stage;
}

void Queue::declare(std::int64_t moved_bytes) { stages_.back().moved_bytes += moved_bytes; }

cl::Event& Queue::record(std::int64_t moved_bytes)
{
    assert(!stages_.empty() && "name the stage before its first launch");
    ++stages_.back().launches;
    stages_.back().moved_bytes += moved_bytes;
    return launches_.emplace_back(Launch{stages_.size() - 1, {}}).event;
}

void Queue::launch(const cl::Kernel& kernel, std::size_t global, std::size_t local,
                   std::int64_t moved_bytes)
{
    queue_.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(global), cl::NDRange(local),
                                nullptr, &record(moved_bytes));
}

void Queue::clear(const cl::Buffer& memory, std::size_t bytes)
{
    queue_.enqueueFillBuffer(memory, cl_uint{0}, 0, bytes, nullptr,
                             &record(static_cast<std::int64_t>(bytes)));
}

void Queue::read(const cl::Buffer& memory, std::size_t bytes, void* to)
{
    queue_.enqueueReadBuffer(memory, CL_TRUE, 0, bytes, to, nullptr,
                             &record(static_cast<std::int64_t>(bytes)));
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
    constexpr auto unset = std::numeric_limits<cl_ulong>::max();
    std::vector<cl_ulong> first(stages_.size(), unset);
    std::vector<cl_ulong> last(stages_.size(), 0);
    for (const Launch& launch : launches_) {
        const auto start = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
        const auto end = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
        stages_[launch.stage].busy_ns += static_cast<std::int64_t>(end - start);
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
