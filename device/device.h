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

/// Bytes of a device's memory that are taken for as long as this, or a copy of it, is there.
using MemoryShare = std::shared_ptr<const std::size_t>;

/// One OpenCL device with its context and its source of kernel text, owned by main and passed down.
///
/// The bindings' own defaults (cl::Device::getDefault and friends) are statics that outlive the driver;
/// nothing here uses them.
struct Device {
    cl::Device cl;
    cl::Context context;
    Sources sources;
    Tuning tuning = {};  ///< set before anything is made for the device; none where nobody sets it

    /// What `parameter` is on this device.
    uint tuned(const Parameter& parameter) const { return tuning.value(parameter, is_cpu()); }

    /// Throws Unavailable, in one sentence that begins with `what`, if the device cannot give a group so much.
    void require_group(std::string_view what, std::size_t group_size,
                       std::size_t local_bytes) const;

    /// Whether its driver ends loops early, as Mesa's llvmpipe does (22.3, as OpenCL through Rusticl): it gives a work-item
    /// 65,535 steps in all its loops together and then ends each loop after one step more. Lanes of a group that no work-item
    /// has use the steps up too: what they load is 0, and a loop that waits for another value runs on in them. OpenCL C
    /// allows neither.
    bool ends_loops = false;

    /// Where loops end early, kernels for few cores still build scenes of up to this size: a work-item has few enough steps.
    static constexpr std::size_t most_triangles_in_short_loops = 16384;

    /// Bytes that all together may take, if less than the device has.
    std::size_t memory_limit = std::numeric_limits<std::size_t>::max();

    /// Bytes that are taken: one account, however often a device is copied.
    std::shared_ptr<std::size_t> taken = std::make_shared<std::size_t>(0);

    std::string name() const { return cl.getInfo<CL_DEVICE_NAME>(); }
    std::string platform() const;

    /// Kernels are written for two kinds of device: many slow lanes in groups, or a few fast cores.
    bool is_cpu() const { return (cl.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0; }

    /// Whether work-groups of one launch may hand work to each other: device/handoff.clh says why there.
    bool lets_groups_meet() const { return is_cpu() || is_nvidia(); }

    /// Whether a group may also wait for one that has started, while others are not even there.
    bool lets_groups_wait() const { return is_nvidia(); }

    /// Bytes that one allocation may take, if less than the device says.
    std::size_t allocation_limit = std::numeric_limits<std::size_t>::max();

    /// Bytes that one allocation may take: on many devices a quarter of the memory.
    std::size_t most_at_once() const
    {
        return std::min<std::size_t>(cl.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>(), allocation_limit);
    }

    /// The number of entries to allocate: `wanted`, which may be a guess, unless one allocation cannot hold them; then as many
    /// as it holds. Never fewer than are `needed`.
    std::size_t room_for(std::uint64_t wanted, std::size_t bytes_each,
                         std::uint64_t needed = 0) const
    {
        return static_cast<std::size_t>(
            std::max(needed, std::min<std::uint64_t>(wanted, most_at_once() / bytes_each)));
    }

    /// Count `bytes` as taken. Throws Unavailable when they will not fit: beside what is taken, or, on a CPU, whose memory
    /// is the host's, into what the host has left (geometry/host_memory.h). Asked before memory is allocated.
    MemoryShare take_memory(std::size_t bytes) const;

    /// Throws Unavailable if one allocation cannot be of `bytes`.
    void require_at_once(std::size_t bytes) const;

private:
    [[noreturn]] void refuse_memory(std::size_t bytes, std::string_view how,
                                    std::size_t given) const;

    bool is_nvidia() const
    {
        return cl.getInfo<CL_DEVICE_EXTENSIONS>().find("cl_nv_") != std::string::npos;
    }
};

/// "Platform/device" of every device there is, in the order an index chooses them.
std::vector<std::string> device_names();

/// The device chosen by `words`: an index into device_names(), or words that its name all contains, in any
/// case; the first CPU device, else the first device, if `words` is empty.
/// Throws Unavailable with the list of devices when none matches or there is none.
Device open_device(std::string_view words, Sources sources = Sources::preferred());

}  // namespace bvhbench
