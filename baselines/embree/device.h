// SPDX-License-Identifier: MIT
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <memory>
#include <string>
#include <thread>
#include <type_traits>

#include "geometry/aabb.h"
#include "geometry/error.h"

namespace bvhbench {

inline std::array<float, 6> sides_of(const Aabb& box)
{
    return std::bit_cast<std::array<float, 6>>(box);
}

/// False for coordinates so large that Embree silently drops triangles that have them.
inline bool is_in_range(const Aabb& box)
{
    return std::ranges::all_of(sides_of(box), [](float x) { return std::abs(x) < 1.844e18f; });
}

/// Throws Unavailable for a triangle that Embree drops.
inline void require_in_range(const Aabb& box, std::size_t triangle)
{
    if (!is_in_range(box))
        throw Unavailable("Embree takes no coordinates beyond 1.8e18, and triangle " +
                          std::to_string(triangle) + " has some");
}

struct EmbreeRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};

/// An owning handle of an Embree object.
template <class Raw>
using EmbreeHandle = std::unique_ptr<std::remove_pointer_t<Raw>, EmbreeRelease>;

/// Memory that an Embree device holds, as the device reports it. Must outlive the device.
class EmbreeMemory {
public:
    /// Counts from now on. The device must hold nothing yet.
    void watch(const EmbreeHandle<RTCDevice>& device)
    {
        rtcSetDeviceMemoryMonitorFunction(device.get(), count, this);
    }

    /// Begins a new peak, at what is held now.
    void begin() { peak_ = held_.load(); }

    /// Returns the most bytes held at once since `begin`.
    std::size_t peak_bytes() const { return static_cast<std::size_t>(std::max(0L, peak_.load())); }

private:
    /// Called from all of Embree's threads, with a negative number of bytes where memory is freed.
    static bool count(void* data, ssize_t bytes, bool)
    {
        auto& memory = *static_cast<EmbreeMemory*>(data);
        const long now = memory.held_ += bytes;
        for (long peak = memory.peak_;
             now > peak && !memory.peak_.compare_exchange_weak(peak, now);)
            ;
        return true;
    }

    std::atomic<long> held_ = 0;
    std::atomic<long> peak_ = 0;
};

/// Starts Embree with one thread per hardware thread, which is `host_threads` in result files. Throws Unavailable on failure.
inline EmbreeHandle<RTCDevice> start_embree()
{
    const std::string threads = "threads=" + std::to_string(std::thread::hardware_concurrency());
    EmbreeHandle<RTCDevice> device(rtcNewDevice(threads.c_str()));
    if (device == nullptr)
        throw Unavailable("Embree could not be started");
    return device;
}

/// Throws Unavailable if an Embree call failed since the last call of this function. The message says "Embree `missing`".
inline void require_success(const EmbreeHandle<RTCDevice>& device, const char* missing)
{
    if (const RTCError error = rtcGetDeviceError(device.get()); error != RTC_ERROR_NONE)
        throw Unavailable(std::string("Embree ") + missing + ": its error " +
                          std::to_string(error));
}

}  // namespace bvhbench
