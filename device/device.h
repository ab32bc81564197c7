// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "device/cl.h"
#include "device/sources.h"
#include "device/tuning.h"

namespace bvhbench {

/// A reservation of bytes of device memory. The bytes count as taken until the last copy is destroyed.
using MemoryShare = std::shared_ptr<const std::size_t>;

/// One OpenCL device with its context and its source of kernel text, owned by main and passed down. The defaults of the C++
/// bindings (cl::Device::getDefault and similar) are not used, because they are static objects that outlive the driver.
struct Device {
    cl::Device cl;
    cl::Context context;
    Sources sources;
    Tuning tuning = {};  ///< must be set before builders and colliders are made; defaults if unset

    /// Returns the value of `parameter` on this device.
    uint tuned(const Parameter& parameter) const { return tuning.value(parameter, is_cpu()); }

    /// Throws Unavailable, with one sentence that begins with `what`, if the device does not support work-groups of
    /// `group_size` work-items or `local_bytes` bytes of local memory per group.
    void require_group(std::string_view what, std::size_t group_size,
                       std::size_t local_bytes) const;

    /// True if the driver ends loops early, as Mesa's llvmpipe does (22.3, through Rusticl). It allows a work-item 65,535
    /// iterations of all its loops together; after that each loop ends after one more iteration. Lanes of a group beyond the
    /// last work-item use up iterations as well: their loads return 0, so a loop that waits for another value runs there until
    /// none are left. OpenCL C allows neither.
    bool ends_loops = false;

    /// Largest number of triangles for which the chunk kernels still work if `ends_loops`: few enough iterations each.
    static constexpr std::size_t most_triangles_in_short_loops = 16384;

    /// Upper bound, in bytes, on all device memory together, if less than the device has.
    std::size_t memory_limit = std::numeric_limits<std::size_t>::max();

    /// Returns the bytes of memory that may be taken together.
    std::size_t memory_bytes() const
    {
        return std::min<std::size_t>(cl.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>(), memory_limit);
    }

    /// True if queues take the host's clock, because the device's is wrong: each stage then waits for the one before.
    bool host_clock = false;

    /// Bytes taken, shared by all copies of this Device.
    std::shared_ptr<std::size_t> taken = std::make_shared<std::size_t>(0);

    /// Most bytes that were taken at once, as seen at each call of take_memory since this was last set to 0.
    std::shared_ptr<std::size_t> most_taken = std::make_shared<std::size_t>(0);

    std::string name() const { return cl.getInfo<CL_DEVICE_NAME>(); }
    std::string platform() const;

    /// True for a CPU. Kernels come in two forms: for a few fast cores (CPUs) and for groups of many slow lanes (all others).
    bool is_cpu() const { return (cl.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0; }

    /// True if work-groups of one launch may hand work to each other; device/handoff.clh gives the reasons.
    bool lets_groups_meet() const { return is_cpu() || is_nvidia(); }

    /// True if a work-group may also wait for a group that has started, even if other groups have not started yet.
    bool lets_groups_wait() const { return is_nvidia(); }

    /// Upper bound, in bytes, on one allocation, if less than the device's own.
    std::size_t allocation_limit = std::numeric_limits<std::size_t>::max();

    /// Returns the largest number of bytes of one allocation; on many devices that is a quarter of the memory.
    std::size_t most_at_once() const
    {
        return std::min<std::size_t>(cl.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>(), allocation_limit);
    }

    /// Returns how many entries of `bytes_each` bytes to allocate: `wanted`, which may be a guess, but at most as many as fit
    /// in one allocation, and never fewer than `needed`.
    std::size_t room_for(std::uint64_t wanted, std::size_t bytes_each,
                         std::uint64_t needed = 0) const
    {
        return static_cast<std::size_t>(
            std::max(needed, std::min<std::uint64_t>(wanted, most_at_once() / bytes_each)));
    }

    /// Counts `bytes` as taken; call it before allocating them. Throws Unavailable if the device has too little memory besides
    /// what is taken, or, on a CPU, if the host has too little free memory (geometry/host_memory.h).
    MemoryShare take_memory(std::size_t bytes) const;

    /// Throws Unavailable if `bytes` exceeds the largest single allocation.
    void require_at_once(std::size_t bytes) const;

private:
    [[noreturn]] void refuse_memory(std::size_t bytes, std::string_view how,
                                    std::size_t given) const;

    bool is_nvidia() const
    {
        return cl.getInfo<CL_DEVICE_EXTENSIONS>().find("cl_nv_") != std::string::npos;
    }
};

/// Returns "Platform/device" of every OpenCL device; `open_device` accepts an index into this list.
std::vector<std::string> device_names();

/// Returns `words`, or if they are empty the value of BVHBENCH_DEVICE, or nothing.
std::string device_words(std::string_view words);

/// Opens the device that device_words(words) select among device_names(), as chosen_device does. Throws Unavailable, with the list
/// of devices, if none matches.
Device open_device(std::string_view words, Sources sources = Sources::preferred());

}  // namespace bvhbench
