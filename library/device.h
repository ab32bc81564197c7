// SPDX-License-Identifier: MIT
//
// What is behind a Device, and how calls on it and its trees begin and end.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>

#include "device/program.h"
#include "device/queue.h"
#include "library/include/bvhbench/oibvh.h"

namespace bvhbench::oibvh {

struct Device::Impl {
    Impl(const cl::CommandQueue& queue, const DeviceOptions& options);

    /// Launch a kernel whose work-items take chunks of `count` items: a few of them on a CPU, up to one an item elsewhere.
    void launch(cl::Kernel& kernel, std::size_t count);

    std::mutex mutex;  ///< trees of a Device share its programs and its account of memory
    bvhbench::Device device;
    Programs programs;
    Queue queue;
};

/// The context of a queue or a buffer, by OpenCL's own call: where it cannot retain the context, the bindings' getInfo would
/// release it all the same.
template <class Handle, class Info>
cl_context context_of(cl_int (*ask)(Handle, Info, std::size_t, void*, std::size_t*), Handle of,
                      std::type_identity_t<Info> what, const char* call)
{
    cl_context context = nullptr;
    if (const cl_int code = ask(of, what, sizeof context, &context, nullptr); code != CL_SUCCESS)
        throw cl::Error(code, call);
    return context;
}

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
