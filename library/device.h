// SPDX-License-Identifier: MIT
//
// What is behind a Device, and how calls on it and its trees begin and end.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "device/program.h"
#include "device/queue.h"
#include "library/include/bvhbench/oibvh.h"

namespace bvhbench::oibvh {

struct Device::Impl {
    Impl(const cl::CommandQueue& queue, const DeviceOptions& options);

    /// Launch a kernel whose work-items take chunks of `count` items: a few of them on a CPU, up to one an item elsewhere.
    void launch(cl::Kernel& kernel, std::size_t count, std::size_t moved_bytes);

    std::mutex mutex;  ///< trees of a Device share its programs and its account of memory
    bvhbench::Device device;
    Programs programs;
    Queue queue;
};

/// `error` as one of the library's, where it is one of the rooms' below. Call it where it was caught.
[[noreturn]] void rethrow_as_error();

/// Run `work` as a call on the device: one at a time, with the library's errors.
template <class Work>
auto as_call(Device::Impl& device, Work&& work)
{
    const std::scoped_lock lock(device.mutex);
    try {
        return std::forward<Work>(work)();
    } catch (...) {
        rethrow_as_error();
    }
}

}  // namespace bvhbench::oibvh
