// SPDX-License-Identifier: MIT
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <string>
#include <thread>
#include <type_traits>

#include "geometry/error.h"

namespace bvhbench {

/// Larger coordinates make Embree drop a triangle, without a word.
inline constexpr float embree_largest_coordinate = 1.844e18f;

struct EmbreeRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};

/// One of Embree's own objects, let go of at the end.
template <class Raw>
using EmbreeHandle = std::unique_ptr<std::remove_pointer_t<Raw>, EmbreeRelease>;

/// On as many threads as every result file says the host has: host_threads.
inline EmbreeHandle<RTCDevice> start_embree()
{
    const std::string threads = "threads=" + std::to_string(std::thread::hardware_concurrency());
    EmbreeHandle<RTCDevice> device(rtcNewDevice(threads.c_str()));
    if (device == nullptr)
        throw Unavailable("Embree could not be started");
    return device;
}

}  // namespace bvhbench
