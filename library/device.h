// SPDX-License-Identifier: MIT
//
// Implementation of Device, and the wrapper that all calls on a Device and its trees run in.
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

    /// Launches a kernel whose work-items share `count` items in chunks (own_chunk): `chunk_count` work-items on a CPU, else
    /// one per item up to 2^20.
    void launch(cl::Kernel& kernel, std::size_t count);

    std::mutex mutex;  ///< guards the programs and the memory account, which all trees share
    bvhbench::Device device;
    Programs programs;
    Queue queue;
};

/// Returns the queue, retained. Throws BadUsage for a null queue or one on the device.
cl::CommandQueue checked(cl_command_queue queue);

/// Returns the context of a queue or a buffer, not retained. Calls OpenCL's C function `ask`, because the C++ bindings'
/// getInfo releases the context even if retaining it failed. Throws cl::Error with `call` as its text.
template <class Handle, class Info>
cl_context context_of(cl_int (*ask)(Handle, Info, std::size_t, void*, std::size_t*), Handle of,
                      std::type_identity_t<Info> what, const char* call)
{
    cl_context context = nullptr;
    if (const cl_int code = ask(of, what, sizeof context, &context, nullptr); code != CL_SUCCESS)
        throw cl::Error(code, call);
    return context;
}

/// Rethrows the exception being handled, converted to an Error of the library if it is BadUsage, Unavailable, BuildFailure
/// or cl::Error. Call it in a catch block.
[[noreturn]] void rethrow_as_error();

/// Runs `work` under the device's mutex and converts its exceptions with `rethrow_as_error`.
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
