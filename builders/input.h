// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "device/buffer.h"
#include "device/queue.h"
#include "geometry/mesh.h"

namespace bvhbench {

/// The triangles to build over, in both memories. Moving them is the harness's work and is never timed.
struct Input {
    std::span<const Point> points;
    std::span<const Face> faces;
    Buffer<Point> device_points;
    Buffer<Face> device_faces;

    uint triangle_count() const { return static_cast<uint>(faces.size()); }
};

/// Copy a mesh to the device. The spans must outlive the input. Waits.
Input upload(const Device& device, const Queue& queue, std::span<const Point> points,
             std::span<const Face> faces);

}  // namespace bvhbench
